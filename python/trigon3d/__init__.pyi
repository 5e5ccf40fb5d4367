from collections.abc import Iterable, Iterator, Sequence
from os import PathLike
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Convention = Literal["opengl", "opencv"]
Output = Literal[
    "color",
    "radiance",
    "depth",
    "object_ids",
    "face_ids",
    "material_ids",
    "triangle_ids",
    "barycentrics",
    "positions",
    "normals",
    "geometric_normals",
    "uvs",
    "albedo",
]
Point = tuple[float, float, float]
Numbers = Sequence[float] | NDArray[Any]
Texture = NDArray[np.uint8] | str | PathLike[str]
View = Camera | tuple[str, Camera, tuple[int, int]]

class TrigonError(Exception): ...
class LoadError(TrigonError): ...
class RenderError(TrigonError): ...
class TrigonWarning(UserWarning): ...

class Camera:
    @staticmethod
    def perspective(
        vertical_fov: float,
        *,
        pose: ArrayLike | None = None,
        convention: Convention = "opengl",
        near: float | None = None,
        far: float | None = None,
    ) -> Camera: ...
    @staticmethod
    def orthographic(
        height: float,
        *,
        pose: ArrayLike | None = None,
        convention: Convention = "opengl",
        near: float | None = None,
        far: float | None = None,
    ) -> Camera: ...
    @staticmethod
    def from_intrinsics(
        K: Sequence[Sequence[float]] | NDArray[Any],
        width: int,
        height: int,
        pose: ArrayLike | None = None,
        *,
        convention: Convention = "opencv",
        near: float | None = None,
        far: float | None = None,
    ) -> Camera: ...
    @staticmethod
    def fisheye(
        K: Sequence[Sequence[float]] | NDArray[Any],
        width: int,
        height: int,
        pose: ArrayLike | None = None,
        *,
        convention: Convention = "opencv",
        distortion: Sequence[float] | NDArray[Any] | None = None,
        fov: float | None = None,
    ) -> Camera: ...
    @staticmethod
    def look_at(
        position: Numbers,
        target: Numbers,
        up: Numbers = (0.0, 1.0, 0.0),
        *,
        vertical_fov: float = 30.0,
        near: float | None = None,
        far: float | None = None,
    ) -> Camera: ...
    def with_pose(self, pose: ArrayLike, *, convention: Convention = "opengl") -> Camera: ...
    def pose(self, convention: Convention = "opengl") -> NDArray[np.float64]: ...
    def extrinsics(self, convention: Convention = "opencv") -> NDArray[np.float64]: ...
    def K(
        self, width: int, height: int, *, convention: Convention = "opencv"
    ) -> NDArray[np.float64] | None: ...
    def project(
        self, points: ArrayLike, width: int, height: int, *, convention: Convention = "opengl"
    ) -> NDArray[np.float64]: ...
    @property
    def position(self) -> Point: ...
    @property
    def forward(self) -> Point: ...

class Material:
    def __init__(
        self,
        color: Numbers | None = None,
        *,
        metallic: float | None = None,
        roughness: float | None = None,
        emission: Numbers | None = None,
        unlit: bool = False,
        double_sided: bool = True,
        alpha_mode: Literal["opaque", "mask", "blend"] = "opaque",
        alpha_cutoff: float = 0.5,
        texture: Texture | None = None,
        metallic_roughness_texture: Texture | None = None,
        normal_texture: Texture | None = None,
        normal_scale: float = 1.0,
        occlusion_texture: Texture | None = None,
        occlusion_strength: float = 1.0,
        emissive_texture: Texture | None = None,
        name: str = "",
    ) -> None: ...

class Frame:
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def color(self) -> NDArray[np.uint8] | None: ...
    @property
    def radiance(self) -> NDArray[np.float32] | None: ...
    @property
    def depth(self) -> NDArray[np.float32] | None: ...
    @property
    def object_ids(self) -> NDArray[np.int32] | None: ...
    @property
    def face_ids(self) -> NDArray[np.int32] | None: ...
    @property
    def material_ids(self) -> NDArray[np.int32] | None: ...
    @property
    def triangle_ids(self) -> NDArray[np.int32] | None: ...
    @property
    def barycentrics(self) -> NDArray[np.float32] | None: ...
    @property
    def positions(self) -> NDArray[np.float32] | None: ...
    @property
    def normals(self) -> NDArray[np.float32] | None: ...
    @property
    def geometric_normals(self) -> NDArray[np.float32] | None: ...
    @property
    def uvs(self) -> NDArray[np.float32] | None: ...
    @property
    def albedo(self) -> NDArray[np.float32] | None: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    def to_png(self) -> bytes: ...

class Scene:
    def __init__(self) -> None: ...
    def add_mesh(
        self,
        vertices: ArrayLike,
        faces: ArrayLike | Sequence[Sequence[int]],
        *,
        normals: ArrayLike | None = None,
        uvs: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        material: Material | None = None,
        pose: ArrayLike | None = None,
        smooth_angle: float | None = None,
        name: str = "mesh",
    ) -> int: ...
    def add_points(
        self,
        points: ArrayLike,
        *,
        colors: ArrayLike | None = None,
        pose: ArrayLike | None = None,
        name: str = "points",
    ) -> int: ...
    def add_light(
        self,
        kind: Literal["ambient", "directional", "point", "spot"] = "directional",
        *,
        color: Numbers = (1.0, 1.0, 1.0),
        intensity: float = 1.0,
        position: Numbers = (0.0, 0.0, 0.0),
        direction: Numbers = (0.0, 0.0, -1.0),
        angle: float = 45.0,
        inner_angle: float | None = None,
        radius: float = 0.0,
    ) -> int: ...
    def add_file(self, path: str | PathLike[str], *, pose: ArrayLike | None = None) -> list[int]: ...
    def set_pose(self, node: int, pose: ArrayLike) -> None: ...
    def set_visible(self, node: int, visible: bool) -> None: ...
    def set_vertices(self, node: int, vertices: ArrayLike) -> None: ...
    def remove(self, node: int) -> None: ...
    @property
    def nodes(self) -> list[dict[str, Any]]: ...
    @property
    def materials(self) -> list[dict[str, Any]]: ...
    @property
    def cameras(self) -> list[Camera]: ...
    @property
    def bounds(self) -> list[Point] | None: ...
    def overview(self, aspect: float = 4 / 3) -> Camera: ...
    def surround(self, count: int, *, seed: int = 0, aspect: float = 1.0) -> list[Camera]: ...
    def render(
        self,
        width: int,
        height: int,
        camera: Camera | None = None,
        *,
        outputs: Output | Sequence[Output] = ("color",),
        samples: int | None = None,
        quality: Literal["draft", "standard", "high", "reference"] | None = None,
        time_budget: float | None = None,
        background: Numbers | Literal["transparent", "default"] | None = None,
        lighting: Literal["auto", "scene", "studio"] | None = None,
        exposure: float | Literal["auto"] | None = None,
        shadows: bool | None = None,
        flat: bool | None = None,
        point_size: float | None = None,
        line_width: float | None = None,
        threads: int | None = None,
        simd: str | None = None,
    ) -> Frame: ...
    @overload
    def render_many(
        self,
        cameras: Iterable[View],
        width: int | None = None,
        height: int | None = None,
        *,
        out: None = None,
        **named: Any,
    ) -> Iterator[Frame]: ...
    @overload
    def render_many(
        self,
        cameras: Iterable[View],
        width: int | None = None,
        height: int | None = None,
        *,
        out: dict[str, NDArray[Any]],
        **named: Any,
    ) -> dict[str, NDArray[Any]]: ...
    def pick(
        self, x: int, y: int, width: int, height: int, camera: Camera | None = None, **named: Any
    ) -> dict[str, Any] | None: ...
    def pick_box(
        self,
        left: float,
        top: float,
        right: float,
        bottom: float,
        width: int,
        height: int,
        camera: Camera | None = None,
        *,
        elements: Literal["nodes", "faces", "vertices", "edges"] = "nodes",
        through: bool = False,
        **named: Any,
    ) -> list[int] | dict[int, NDArray[np.int32]]: ...
    def explain_pixel(
        self, x: int, y: int, width: int, height: int, camera: Camera | None = None, **named: Any
    ) -> dict[str, Any]: ...
    def frontier(
        self,
        width: int,
        height: int,
        camera: Camera | None = None,
        *,
        rounds: int = 5,
        seed: int = 0,
        **named: Any,
    ) -> dict[str, Any]: ...
    def check(self) -> list[dict[str, str]]: ...
    def plan(self, width: int, height: int, camera: Camera | None = None, **named: Any) -> dict[str, str]: ...

def load(path: str | PathLike[str], *, up: str | None = None) -> Scene: ...
def load_cameras(
    path: str | PathLike[str], width: int = 640, height: int = 480
) -> list[tuple[str, Camera, tuple[int, int]]]: ...
def set_threads(count: int) -> None: ...
def from_trimesh(source: Any) -> Scene: ...
def save_image(source: Any, resolution: tuple[int, int] = (640, 480), **named: Any) -> bytes: ...
