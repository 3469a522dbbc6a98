#pragma once

#include "rooms/builder.h"

#include <functional>
#include <span>

#include <glm/vec3.hpp>

namespace relamp::rooms
{

/// A piece that stands against a wall: its frame's origin is on the floor at the wall, in the
/// middle of it.
struct Piece
{
    glm::vec3 size{0.0f}; // m: width, height, depth
    std::function<void(Builder&, const Frame&, glm::vec3 size)> build;
};

/// Any of wardrobe, shelf, bed, sofa, desk and chest.
Piece anyPiece(Builder& builder);
Piece nightstand();

/// A table with chairs, an armchair or a carton: stands in the middle of its frame, within 0.9 m.
void buildFreePiece(Builder& builder, const Frame& frame);

} // namespace relamp::rooms
