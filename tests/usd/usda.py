"""Reads USD scenes as text, as far as relamp writes them.

No sublayers, references, time samples or inherited opinions.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Tuple

import numpy as np

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
TOKENS = re.compile(
    rf"""\s*(?:
    (?P<string>"(?:[^"\\\n]|\\.)*") | (?P<asset>@[^@\n]*@) | (?P<path><[^<>\n]*>) |
    (?P<number>{NUMBER})(?![\w.]) | (?P<word>[A-Za-z_][\w:.]*(?:\[\])?) | (?P<mark>[()\[\]{{}}=,])
    )""",
    re.VERBOSE,
)
ESCAPES = {"n": "\n", "t": "\t", '"': '"', "\\": "\\"}


class Malformed(Exception):
    """What is no usda, or none as relamp writes it."""


@dataclass
class Attribute:
    type: str
    uniform: bool = False
    value: Any = None  # a number, text, tuple, array or list; None: declared only
    connection: Optional[str] = None
    metadata: Dict[str, Any] = field(default_factory=dict)


@dataclass
class Prim:
    specifier: str
    type: str
    name: str
    metadata: Dict[str, Any] = field(default_factory=dict)
    attributes: Dict[str, Attribute] = field(default_factory=dict)
    relationships: Dict[str, str] = field(default_factory=dict)
    children: List["Prim"] = field(default_factory=list)
    variant_sets: Dict[str, Dict[str, "Prim"]] = field(default_factory=dict)

    def child(self, name: str) -> Optional["Prim"]:
        return next((child for child in self.children if child.name == name), None)


def text_of(literal: str) -> str:
    def meant(match: "re.Match[str]") -> str:
        code = match.group(1)
        return chr(int(code[1:], 16)) if code[0] == "x" else ESCAPES.get(code, code)

    return re.sub(r"\\(x[0-9a-fA-F]{2}|.)", meant, literal[1:-1])


class Reader:
    def __init__(self, text: str) -> None:
        self.text = text
        self.at = 0

    def fail(self, what: str) -> Malformed:
        line = self.text.count("\n", 0, self.at) + 1
        return Malformed(f"line {line}: {what}")

    def peek(self) -> Tuple[str, str]:
        match = TOKENS.match(self.text, self.at)
        if not match and not self.text[self.at :].strip():
            return "end", ""
        if not match:
            raise self.fail("no usda: " + repr(self.text[self.at : self.at + 30]))
        kind = match.lastgroup or ""
        return kind, match.group(kind)

    def take(self, *wanted: str) -> str:
        kind, token = self.peek()
        if wanted and kind not in wanted and token not in wanted:
            raise self.fail(f"{token!r} where {' or '.join(wanted)} has to be")
        match = TOKENS.match(self.text, self.at)
        self.at = match.end() if match else len(self.text)
        return token

    def is_next(self, token: str) -> bool:
        return self.peek()[1] == token

    def numbers(self) -> Any:
        """An array of numbers or of tuples of them, which may have millions."""
        end = self.text.find("]", self.at)
        if end < 0:
            raise self.fail("an array that does not end")
        inside = self.text[self.at : end]
        values = re.findall(NUMBER, inside)
        shape = re.sub(NUMBER, "n", inside).replace(" ", "")
        width = shape.find(")") // 2 if shape.startswith("(") else 0
        one = "(" + ",".join("n" * width) + ")" if width else "n"
        count = len(values) // max(width, 1)
        if shape != ",".join([one] * count):
            raise self.fail("an array of which not all elements are alike")
        self.at = end + 1
        array = np.array([float(value) for value in values])
        return array.reshape(-1, width) if width else array

    def value(self) -> Any:
        kind, token = self.peek()
        if kind == "number":
            return float(self.take())
        if token in ("true", "false"):
            return self.take() == "true"
        if kind == "string":
            return text_of(self.take())
        if kind in ("asset", "path"):
            return self.take()[1:-1]
        if token == "(":
            self.take()
            parts = [self.value()]
            while not self.is_next(")"):
                self.take(",")
                parts.append(self.value())
            self.take(")")
            return tuple(parts)
        if token == "[":
            self.take()
            if self.peek()[0] != "string":
                return self.numbers()
            texts = [self.value()]
            while not self.is_next("]"):
                self.take(",")
                texts.append(self.value())
            self.take("]")
            return texts
        raise self.fail(f"{token!r} where a value has to be")

    def dictionary(self) -> Dict[str, Any]:
        self.take("{")
        entries: Dict[str, Any] = {}
        while not self.is_next("}"):
            self.take("word")
            name = self.take("word")
            self.take("=")
            entries[name] = self.value()
        self.take("}")
        return entries

    def metadata(self) -> Dict[str, Any]:
        entries: Dict[str, Any] = {}
        if not self.is_next("("):
            return entries
        self.take("(")
        while not self.is_next(")"):
            name = self.take("word")
            if name == "prepend":
                name = self.take("word")
            self.take("=")
            if name in entries:
                raise self.fail(f"{name} twice")
            entries[name] = self.dictionary() if self.is_next("{") else self.value()
        self.take(")")
        return entries

    def attribute(self, prim: Prim) -> None:
        uniform = self.is_next("uniform")
        if uniform:
            self.take()
        kind = self.take("word")
        name = self.take("word")
        if kind == "rel":
            self.take("=")
            prim.relationships[name] = self.take("path")[1:-1]
            return
        is_connection = name.endswith(".connect")
        name = name[: -len(".connect")] if is_connection else name
        if name in prim.attributes:
            raise self.fail(f"{name} twice")
        attribute = prim.attributes[name] = Attribute(kind, uniform)
        if is_connection:
            self.take("=")
            attribute.connection = self.take("path")[1:-1]
        elif self.is_next("="):
            self.take("=")
            attribute.value = self.value()
        attribute.metadata = self.metadata()

    def variant_set(self, prim: Prim) -> None:
        self.take("variantSet")
        variants = prim.variant_sets[text_of(self.take("string"))] = {}
        self.take("=")
        self.take("{")
        while not self.is_next("}"):
            name = text_of(self.take("string"))
            variants[name] = Prim("variant", "", name)
            self.body(variants[name])
        self.take("}")

    def body(self, prim: Prim) -> None:
        self.take("{")
        while not self.is_next("}"):
            token = self.peek()[1]
            if token in ("def", "over"):
                prim.children.append(self.prim())
            elif token == "variantSet":
                self.variant_set(prim)
            else:
                self.attribute(prim)
        self.take("}")

    def prim(self) -> Prim:
        specifier = self.take("def", "over")
        kind = self.take() if self.peek()[0] == "word" else ""
        prim = Prim(specifier, kind, text_of(self.take("string")))
        prim.metadata = self.metadata()
        self.body(prim)
        return prim

    def layer(self) -> Prim:
        header = "#usda 1.0\n"
        if not self.text.startswith(header):
            raise self.fail("does not begin with #usda 1.0")
        self.at = len(header)
        top = Prim("layer", "", "")
        top.metadata = self.metadata()
        while self.peek()[0] != "end":
            top.children.append(self.prim())
        return top


def read(file: Path) -> Prim:
    """The layer, whose children are the prims on top."""
    return Reader(file.read_bytes().decode("utf-8")).layer()


def prims_below(prim: Prim, path: str = "") -> Iterator[Tuple[str, Prim]]:
    """Every prim with its path, those of variants as if chosen."""
    for child in prim.children:
        yield f"{path}/{child.name}", child
        yield from prims_below(child, f"{path}/{child.name}")
    for variants in prim.variant_sets.values():
        for variant in variants.values():
            yield from prims_below(variant, path)
