"""What people read: docstrings and stubs."""

import ast
import doctest
import importlib
import inspect
from pathlib import Path

import pytest
import relamp


PARTS = [f"relamp.{part}" for part in ("delight", "room", "page", "relit", "lights", "inspection", "verification")]


@pytest.mark.parametrize("part", PARTS)
def test_examples_of_docstrings_are_true(part, room):
    module = importlib.import_module(part)
    failed, _ = doctest.testmod(module, extraglobs={"room": room, "relamp": relamp})
    assert failed == 0


def test_every_public_thing_says_what_it_is():
    for name in relamp.__all__:
        thing = getattr(relamp, name)
        if name.startswith("__"):
            continue
        assert inspect.getdoc(thing), name
        members = inspect.getmembers(thing) if inspect.isclass(thing) else []
        for member, value in members:
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert inspect.getdoc(value), f"{name}.{member}"


def test_stub_names_what_the_module_has():
    stub = ast.parse((Path(relamp.__file__).parent / "_relamp.pyi").read_text())
    module = importlib.import_module("relamp._relamp")
    named = {node.name for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    named |= {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)} - {"__version__"}
    assert named == {name for name in dir(module) if not name.startswith("_")}
    for node in stub.body:
        if isinstance(node, ast.ClassDef) and node.name != "Error":
            members = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
            has = {name for name in vars(getattr(module, node.name)) if not name.startswith("_")}
            assert members - {"__init__"} == has, node.name
