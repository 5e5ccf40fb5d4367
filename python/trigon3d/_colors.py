"""Linear light and sRGB."""

from typing import Any

import numpy as np


def encoded(linear: Any) -> np.ndarray:
    """Linear light as sRGB."""
    linear = np.asarray(linear, dtype=np.float64)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.power(linear, 1 / 2.4) - 0.055)
