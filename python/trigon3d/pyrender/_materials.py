"""Colours, textures and materials."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import _trigon3d as trigon
from .._colors import encoded


def color_vector(value: Any, length: int) -> np.ndarray:
    """A colour of so many numbers; whole numbers are divided by 255, and missing ones are 1."""
    if isinstance(value, float):
        value = np.repeat(value, length)
    color = np.asarray(value).squeeze()
    if color.ndim == 0:
        color = np.repeat(color, length)
    if color.ndim != 1 or color.dtype.kind not in "fiub":
        raise ValueError("a colour is a row of numbers")
    if color.dtype.kind in "iu":
        color = color / 255
    color = np.append(color, np.ones(max(length - len(color), 0)))[:length]
    return np.clip(color, 0, 1)


def color_rows(value: Any, count: int) -> np.ndarray:
    """A colour of four numbers from 0 to 1 for each vertex."""
    colors = np.asarray(value)
    if colors.dtype.kind in "iu":
        colors = colors / 255
    if colors.ndim == 1:
        colors = np.tile(colors, (count, 1))
    if colors.shape[1] == 3:
        colors = np.column_stack([colors, np.ones(len(colors))])
    return np.clip(colors, 0, 1)


class Sampler:
    """How a texture is filtered. trigon always filters as well as it can."""

    def __init__(self, name=None, magFilter=None, minFilter=None, wrapS=10497, wrapT=10497):
        self.name, self.magFilter, self.minFilter, self.wrapS, self.wrapT = name, magFilter, minFilter, wrapS, wrapT


class Texture:
    """An image: an array or one of Pillow's."""

    def __init__(
        self,
        name=None,
        sampler=None,
        source=None,
        source_channels=None,
        width=None,
        height=None,
        tex_type=None,
        data_format=None,
    ):
        self.name, self.sampler, self.source, self.source_channels = name, sampler, source, source_channels


def image(texture: Any) -> np.ndarray | None:
    """A texture as bytes of 1, 3 or 4 channels."""
    source = texture.source if isinstance(texture, Texture) else texture
    if source is None:
        return None
    if getattr(source, "mode", None) == "P":
        source = source.convert("RGBA")
    array = np.asarray(source)
    array = (array * 255).astype(np.uint8) if array.dtype.kind == "f" else array.astype(np.uint8)
    if array.ndim == 3 and array.shape[2] == 2:
        # Green and blue alone, as pyrender keeps roughness and metal.
        array = np.dstack([np.zeros_like(array[..., :1]), array])
    return array


class Material:
    """What all materials have."""

    def __init__(
        self,
        name=None,
        normalTexture=None,
        occlusionTexture=None,
        emissiveTexture=None,
        emissiveFactor=None,
        alphaMode=None,
        alphaCutoff=None,
        doubleSided=False,
        smooth=True,
        wireframe=False,
    ):
        self.name = name
        self.normalTexture, self.occlusionTexture = normalTexture, occlusionTexture
        self.emissiveTexture, self.emissiveFactor = emissiveTexture, emissiveFactor
        self.alphaMode = alphaMode or "OPAQUE"
        self.alphaCutoff = 0.5 if alphaCutoff is None else alphaCutoff
        self.doubleSided = bool(doubleSided)
        self.smooth = smooth
        self.wireframe = wireframe
        if self.alphaMode not in ("OPAQUE", "MASK", "BLEND"):
            raise ValueError(f"alphaMode is {alphaMode!r}, not 'OPAQUE', 'MASK' or 'BLEND'")

    @property
    def emissiveFactor(self):
        """The light that it gives, three linear numbers."""
        return self._emissiveFactor

    @emissiveFactor.setter
    def emissiveFactor(self, value):
        self._emissiveFactor = np.zeros(3) if value is None else color_vector(value, 3)


class MetallicRoughnessMaterial(Material):
    """A metal or not. ``baseColorFactor`` is linear light, as in glTF; textures are arrays or images."""

    def __init__(
        self,
        name=None,
        normalTexture=None,
        occlusionTexture=None,
        emissiveTexture=None,
        emissiveFactor=None,
        alphaMode=None,
        alphaCutoff=None,
        doubleSided=False,
        smooth=True,
        wireframe=False,
        baseColorFactor=None,
        baseColorTexture=None,
        metallicFactor=1.0,
        roughnessFactor=1.0,
        metallicRoughnessTexture=None,
    ):
        super().__init__(
            name,
            normalTexture,
            occlusionTexture,
            emissiveTexture,
            emissiveFactor,
            alphaMode,
            alphaCutoff,
            doubleSided,
            smooth,
            wireframe,
        )
        self.baseColorFactor = baseColorFactor
        self.baseColorTexture = baseColorTexture
        self.metallicFactor = 1.0 if metallicFactor is None else float(metallicFactor)
        self.roughnessFactor = 1.0 if roughnessFactor is None else float(roughnessFactor)
        self.metallicRoughnessTexture = metallicRoughnessTexture

    @property
    def baseColorFactor(self):
        """Four linear numbers."""
        return self._baseColorFactor

    @baseColorFactor.setter
    def baseColorFactor(self, value):
        self._baseColorFactor = np.ones(4) if value is None else color_vector(value, 4)

    @property
    def is_transparent(self):
        """Whether anything is seen through it."""
        if self.alphaMode != "BLEND":
            return False
        texture = image(self.baseColorTexture)
        has_holes = texture is not None and texture.ndim == 3 and texture.shape[2] == 4 and texture[..., 3].min() < 255
        return bool(has_holes or self.baseColorFactor[3] < 1)

    def _translated(self, look: Look, is_transparent: bool) -> trigon.Material:
        factor, is_unlit = self.baseColorFactor, look.is_flat
        if look.ambient is not None and self.occlusionTexture is None and not self.emissiveFactor.any():
            # Nothing but its colour times the ambient light is left of pyrender's shader.
            color, is_unlit = encoded(factor[:3] * look.ambient), True
        else:
            # Flat colours are shown as they are given.
            color = factor[:3] if look.is_flat else encoded(factor[:3])
        mode: Any = {"OPAQUE": "opaque", "MASK": "mask", "BLEND": "blend" if is_transparent else "opaque"}[self.alphaMode]
        return trigon.Material(
            [*color, factor[3]],
            unlit=is_unlit,
            metallic=self.metallicFactor,
            roughness=self.roughnessFactor,
            emission=encoded(self.emissiveFactor) if not look.is_flat else np.zeros(3),
            double_sided=look.is_double_sided or self.doubleSided,
            alpha_mode=mode,
            alpha_cutoff=self.alphaCutoff,
            texture=image(self.baseColorTexture),
            metallic_roughness_texture=image(self.metallicRoughnessTexture),
            normal_texture=image(self.normalTexture),
            occlusion_texture=image(self.occlusionTexture),
            emissive_texture=image(self.emissiveTexture),
        )


class Look:
    """How all materials of a scene are drawn: what flags say, and the ambient light if there is no other."""

    def __init__(self, is_double_sided: bool, is_flat: bool, ambient: np.ndarray | None = None):
        self.is_double_sided, self.is_flat, self.ambient = is_double_sided, is_flat, ambient

    def key(self) -> tuple:
        """Equal for looks that are drawn alike."""
        return self.is_double_sided, self.is_flat, None if self.ambient is None else tuple(self.ambient)


def usual(color: float) -> MetallicRoughnessMaterial:
    """The material of trimeshes that have none."""
    return MetallicRoughnessMaterial(
        alphaMode="BLEND", baseColorFactor=[color, color, color, 1.0], metallicFactor=0.2, roughnessFactor=0.8
    )


def of_trimesh(material: Any) -> MetallicRoughnessMaterial:
    """A material of trimesh as pyrender reads it: PBR, or of an OBJ, which becomes a metal."""
    if isinstance(material, MetallicRoughnessMaterial):
        return material
    if hasattr(material, "baseColorFactor"):
        names = ["normalTexture", "occlusionTexture", "emissiveTexture", "emissiveFactor", "baseColorFactor"]
        names += ["baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture"]
        named = {name: getattr(material, name, None) for name in names}
        return MetallicRoughnessMaterial(
            alphaMode="BLEND", doubleSided=material.doubleSided, alphaCutoff=material.alphaCutoff, **named
        )
    shininess = getattr(material, "kwargs", {}).get("Ns", 1.0)
    shininess = float(np.ravel(shininess)[0])
    return MetallicRoughnessMaterial(
        alphaMode="BLEND",
        roughnessFactor=(2 / (shininess + 2)) ** 0.25,
        baseColorFactor=material.diffuse,
        baseColorTexture=material.image,
    )
