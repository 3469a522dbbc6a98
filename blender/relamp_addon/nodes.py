"""Short words for building node trees."""

from __future__ import annotations

import bpy


class Builder:
    def __init__(self, tree: bpy.types.NodeTree):
        self.tree = tree
        self.column = 0

    def add(self, kind: str, **properties) -> bpy.types.Node:
        node = self.tree.nodes.new(kind)
        for name, value in properties.items():
            setattr(node, name, value)
        node.location = (self.column * 200 - 1600, -160 * (len(self.tree.nodes) % 4))
        self.column += 1
        return node

    def link(self, source: bpy.types.NodeSocket, target: bpy.types.NodeSocket) -> None:
        self.tree.links.new(source, target)

    def put(self, value, socket: bpy.types.NodeSocket) -> None:
        """A socket's output, or a number."""
        if isinstance(value, bpy.types.NodeSocket):
            self.link(value, socket)
        else:
            socket.default_value = value

    def maths(self, operation: str, *values) -> bpy.types.NodeSocket:
        node = self.add("ShaderNodeMath", operation=operation)
        for value, socket in zip(values, node.inputs):
            self.put(value, socket)
        return node.outputs[0]

    def mix(self, share, first: bpy.types.NodeSocket,
            second: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
        node = self.add("ShaderNodeMixShader")
        self.put(share, node.inputs[0])
        self.link(first, node.inputs[1])
        self.link(second, node.inputs[2])
        return node.outputs[0]

    def emission(self, colour: bpy.types.NodeSocket, strength=1.0) -> bpy.types.NodeSocket:
        node = self.add("ShaderNodeEmission")
        self.link(colour, node.inputs["Color"])
        self.put(strength, node.inputs["Strength"])
        return node.outputs[0]

    def texture(self, image: bpy.types.Image, vector: bpy.types.NodeSocket,
                **properties) -> bpy.types.Node:
        node = self.add("ShaderNodeTexImage", image=image, extension="EXTEND", **properties)
        self.link(vector, node.inputs["Vector"])
        return node
