#!/usr/bin/env python3
"""Holds USD scenes of relamp to the published schemas: `check_usda.py FILE...`, a line a fault."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional

import numpy as np
import schema
from usda import Attribute, Malformed, Prim, prims_below, read

NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")


def is_of_type(value: Any, kind: str) -> bool:
    """Whether a value is one of a type; numbers have to be finite."""
    if kind.endswith("[]"):
        if kind == "token[]":
            return isinstance(value, list)
        one = kind[:-2]
        if not isinstance(value, np.ndarray) or not np.isfinite(value).all():
            return False
        if one in schema.WIDTH:
            return value.size == 0 or value.ndim == 2 and value.shape[1] == schema.WIDTH[one]
        return value.ndim == 1 and (one != "int" or bool((value == np.round(value)).all()))
    if kind in ("string", "token", "asset"):
        return isinstance(value, str)
    if kind == "matrix4d":
        return np.array(value).shape == (4, 4) and bool(np.isfinite(np.array(value)).all())
    if kind in schema.WIDTH:
        is_wide = isinstance(value, tuple) and len(value) == schema.WIDTH[kind]
        return is_wide and bool(np.isfinite(value).all())
    if not isinstance(value, float) or not np.isfinite(value):
        return False
    if kind == "int":
        return value == round(value)
    return kind == "float" or (kind == "bool" and value in (0, 1))


class Checker:
    def __init__(self, file: Path) -> None:
        self.folder = file.parent
        self.layer = read(file)
        self.prims: Dict[str, Prim] = {}
        for path, prim in prims_below(self.layer):
            if prim.specifier == "def":
                self.prims[path] = prim

    def complaints(self) -> Iterator[str]:
        yield from self.of_layer()
        for path, prim in [("layer", self.layer), *prims_below(self.layer)]:
            known = schema.METADATA if prim.specifier != "layer" else schema.LAYER_METADATA
            for name, value in prim.metadata.items():
                if type(value) is not known.get(name):
                    yield f"{path}: metadata {name} is not known, or of another type"
        yield from self.of_names(self.layer, "")
        for path, prim in prims_below(self.layer):
            defined = self.prims.get(path)
            if defined is None:
                yield f"{path}: over nothing that is defined"
                continue
            yield from self.of_attributes(path, prim, defined)
            for name, target in prim.relationships.items():
                if name != "material:binding":
                    yield f"{path}: no schema has the relationship {name}"
                elif target not in self.prims or self.prims[target].type != "Material":
                    yield f"{path}: {name} leads to {target}, which is no material"
            if prim.specifier == "def" and prim.type == "Mesh":
                yield from self.of_mesh(path, prim)
            if prim.specifier == "def" and prim.type.endswith("Light"):
                yield from self.of_light(path, prim)

    def of_layer(self) -> Iterator[str]:
        metadata = self.layer.metadata
        if metadata.get("upAxis") != "Y" or metadata.get("metersPerUnit") != 1:
            yield "layer: upAxis and metersPerUnit are not Y and 1"
        top = self.layer.child(metadata.get("defaultPrim", ""))
        if top is None:
            yield "layer: defaultPrim names no prim"
            return
        chosen = top.metadata.get("variants", {})
        if sorted(chosen) != sorted(top.variant_sets):
            yield "layer: not every variant set has a selection"
        for name, variant in chosen.items():
            if variant not in top.variant_sets.get(name, {}):
                yield f"layer: variant {variant} of {name} is not there"

    def of_names(self, prim: Prim, path: str) -> Iterator[str]:
        names = [child.name for child in prim.children]
        for name in names:
            if not NAME.match(name):
                yield f"{path}/{name}: no name of a prim"
            if names.count(name) > 1:
                yield f"{path}/{name}: twice"
        for child in prim.children:
            yield from self.of_names(child, f"{path}/{child.name}")
        for variants in prim.variant_sets.values():
            for variant in variants.values():
                yield from self.of_names(variant, path)

    def known(self, prim: Prim) -> Optional[Dict[str, str]]:
        if prim.type not in schema.ATTRIBUTES:
            return None
        names = dict(schema.ATTRIBUTES[prim.type])
        if prim.type == "Mesh":
            names.update(schema.PRIMVARS)
        if prim.type == "Shader":
            shader = prim.attributes.get("info:id")
            names.update(schema.SHADERS.get(shader.value if shader else "", {}))
        return names

    def of_attributes(self, path: str, prim: Prim, defined: Prim) -> Iterator[str]:
        known = self.known(defined)
        if known is None:
            yield f"{path}: no schema of a {defined.type}"
            return
        for name, attribute in prim.attributes.items():
            where = f"{path}.{name}"
            kind = ("uniform " if attribute.uniform else "") + attribute.type
            if known.get(name) != kind:
                wanted = known.get(name, "no such attribute")
                yield f"{where}: of type {kind}, and the schema has {wanted}"
            elif attribute.connection is not None:
                yield from self.of_connection(where, attribute)
            elif attribute.value is None:
                if not name.startswith("outputs:"):
                    yield f"{where}: has no value"
            elif not is_of_type(attribute.value, attribute.type):
                yield f"{where}: its value is no {attribute.type}"
            elif name in schema.TOKENS and attribute.value not in schema.TOKENS[name]:
                yield f"{where}: may not be {attribute.value}"
            elif attribute.type == "asset" and not (self.folder / attribute.value).is_file():
                yield f"{where}: {attribute.value} is not there"

    def of_connection(self, where: str, attribute: Attribute) -> Iterator[str]:
        path, _, name = str(attribute.connection).partition(".")
        source = self.prims.get(path)
        if source is None or name not in source.attributes:
            yield f"{where}: leads to {attribute.connection}, which is not there"
            return
        may = {attribute.type} | schema.CONNECTABLE.get(attribute.type, set())
        if source.attributes[name].type not in may:
            yield f"{where}: leads to a {source.attributes[name].type}"

    def of_mesh(self, path: str, mesh: Prim) -> Iterator[str]:
        needed = {"points", "faceVertexCounts", "faceVertexIndices", "extent"}
        missing = needed - set(mesh.attributes)
        if missing:
            yield f"{path}: has no {', '.join(sorted(missing))}"
            return
        values = {name: np.atleast_1d(a.value) for name, a in mesh.attributes.items()}
        points = values["points"]
        indices, counts = values["faceVertexIndices"], values["faceVertexCounts"]
        if counts.sum() != len(indices):
            yield f"{path}: faces of {counts.sum():.0f} corners, but {len(indices)} indices"
        if len(indices) and (indices.min() < 0 or indices.max() >= len(points)):
            yield f"{path}: an index beyond its {len(points)} points"
        box = np.array([points.min(axis=0), points.max(axis=0)]) if len(points) else None
        if box is None or not np.array_equal(values["extent"], box):
            yield f"{path}: extent is not the box around its points"
        wanted = {"vertex": len(points), "faceVarying": len(indices)}
        wanted |= {"uniform": len(counts), "constant": 1}
        for name in mesh.attributes:
            if name != "normals" and not name.startswith("primvars:"):
                continue
            how = mesh.attributes[name].metadata.get("interpolation")
            if how not in schema.INTERPOLATIONS:
                yield f"{path}.{name}: has no interpolation"
            elif len(values[name]) != wanted.get(how, len(points)):
                yield f"{path}.{name}: {len(values[name])} values of {wanted.get(how)}"
        lengths = np.linalg.norm(values.get("normals", np.ones((1, 1))), axis=1)
        if np.abs(lengths - 1).max() > 1e-4:
            yield f"{path}.normals: not all of unit length"
        if "material:binding" not in mesh.relationships:
            yield f"{path}: has no material"
        elif "MaterialBindingAPI" not in mesh.metadata.get("apiSchemas", []):
            yield f"{path}: is bound without MaterialBindingAPI"

    def of_light(self, path: str, light: Prim) -> Iterator[str]:
        value = {name: a.value for name, a in light.attributes.items()}
        color = np.array(value.get("inputs:color", (1, 1, 1)))
        if not value.get("inputs:intensity", 0) > 0 or color.min() < 0 or color.max() != 1:
            yield f"{path}: has no brightness, or a colour whose largest part is not 1"
        for name in ("inputs:width", "inputs:height", "inputs:radius"):
            if not value.get(name, 1) > 0:
                yield f"{path}.{name}: is not above 0"
        if value.get("inputs:normalize", 0) != (light.type == "DistantLight"):
            yield f"{path}: is normalized, or a sun that is not, and taken for radiance or lux"
        if light.type == "DomeLight":
            return
        place = np.array(value.get("xformOp:transform", np.zeros((4, 4))))
        turn = place[:3, :3]
        is_turn = np.abs(turn @ turn.T - np.eye(3)).max() < 1e-5 and np.linalg.det(turn) > 0
        if not is_turn or (place[:, 3] != (0, 0, 0, 1)).any():
            yield f"{path}: its transform is more than a turn and a move"
        if value.get("xformOpOrder") != ["xformOp:transform"]:
            yield f"{path}: its transform is not in xformOpOrder"


def check(file: Path) -> List[str]:
    """What is wrong with a scene; nothing where it is as it has to be."""
    try:
        return list(Checker(file).complaints())
    except (Malformed, UnicodeDecodeError) as error:
        return [str(error)]


if __name__ == "__main__":
    wrong = [f"{file}: {complaint}" for file in sys.argv[1:] for complaint in check(Path(file))]
    print("\n".join(wrong) or "as the schemas have it")
    sys.exit(1 if wrong else 0)
