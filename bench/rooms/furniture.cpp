#include "rooms/furniture.h"

namespace relamp::rooms
{
namespace
{

void buildChest(Builder& b, const Frame& frame, glm::vec3 size)
{
    const int body = b.anyPaint(0.45f);
    b.box(frame, {-0.5f * size.x, 0, 0.01f}, {0.5f * size.x, size.y, size.z}, body);
    const int drawer = b.anyPaint(0.5f);
    for (float y = 0.06f; y + 0.2f < size.y; y += 0.24f)
        b.box(frame, {-0.5f * size.x + 0.04f, y, size.z},
              {0.5f * size.x - 0.04f, y + 0.2f, size.z + 0.02f}, drawer, allButBack);
}

void buildShelf(Builder& b, const Frame& frame, glm::vec3 size)
{
    constexpr float kBoard = 0.03f; // m thick
    const int wood = b.anyPaint(0.5f);
    const float half = 0.5f * size.x;
    b.box(frame, {-half, 0, 0.01f}, {-half + kBoard, size.y, size.z}, wood);
    b.box(frame, {half - kBoard, 0, 0.01f}, {half, size.y, size.z}, wood);
    b.box(frame, {-half, 0, 0.01f}, {half, size.y, 0.01f + kBoard}, wood);
    for (float y = 0.05f; y < size.y - 0.2f; y += 0.38f) {
        b.box(frame, {-half + kBoard, y, 0.01f + kBoard}, {half - kBoard, y + kBoard, size.z}, wood,
              allFaces);
        for (float x = -half + kBoard + 0.01f; x < half - 0.2f; x += b.between(0.05f, 0.3f)) {
            const float width = b.between(0.03f, 0.12f); // of books
            b.box(frame, {x, y + kBoard, 0.05f},
                  {x + width, y + b.between(0.18f, 0.32f), size.z - 0.04f},
                  b.add({.first = b.anyColour(b.between(0.1f, 0.7f), 0.8f)}));
            x += width;
        }
    }
}

void buildBed(Builder& b, const Frame& frame, glm::vec3 size)
{
    const float half = 0.5f * size.x;
    b.box(frame, {-half, 0, 0.06f}, {half, 0.28f, size.z}, b.anyPaint(0.4f));
    const int cover = b.anyPaint(0.6f);
    b.box(frame, {-half + 0.03f, 0.28f, 0.08f}, {half - 0.03f, size.y, size.z - 0.03f}, cover);
    b.box(frame, {-half, 0, 0.01f}, {half, 2.0f * size.y, 0.06f}, b.anyPaint(0.4f));
    const int linen = b.add({.first = glm::vec3(0.78f)});
    for (const float x : {-0.5f * half, 0.5f * half})
        b.box(frame.moved({x, size.y, 0.35f}, b.between(-0.1f, 0.1f)), {-0.3f, 0, -0.2f},
              {0.3f, 0.12f, 0.2f}, linen);
}

void buildSofa(Builder& b, const Frame& frame, glm::vec3 size)
{
    const int cloth = b.anyPaint(0.4f);
    const float half = 0.5f * size.x;
    b.box(frame, {-half, 0, 0.02f}, {half, 0.42f, size.z}, cloth);
    b.box(frame, {-half, 0.42f, 0.02f}, {half, size.y, 0.25f}, cloth);
    for (const float x : {-half, half - 0.18f})
        b.box(frame, {x, 0.42f, 0.25f}, {x + 0.18f, 0.6f, size.z}, cloth);
    b.box(frame.moved({0.4f * half, 0.42f, 0.45f}, 0.4f), {-0.2f, 0, -0.08f}, {0.2f, 0.38f, 0.08f},
          b.anyPaint(0.6f));
}

void buildTable(Builder& b, const Frame& frame, glm::vec3 size)
{
    const int wood = b.anyPaint(0.5f);
    const float half = 0.5f * size.x;
    b.box(frame, {-half, size.y - 0.04f, 0.02f}, {half, size.y, size.z}, wood, allFaces);
    for (const float x : {-half + 0.03f, half - 0.09f})
        for (const float z : {0.05f, size.z - 0.09f})
            b.box(frame, {x, 0, z}, {x + 0.06f, size.y - 0.04f, z + 0.06f}, wood, allButBottom);
    b.box(frame.moved({b.between(-0.3f, 0.3f) * half, size.y, 0.5f * size.z}, b.between(0, 3)),
          {-0.15f, 0, -0.1f}, {0.15f, b.between(0.02f, 0.2f), 0.1f}, b.anyPaint(0.6f));
}

void buildChair(Builder& b, const Frame& frame, int paint)
{
    b.box(frame, {-0.22f, 0.43f, -0.22f}, {0.22f, 0.47f, 0.22f}, paint, allFaces);
    b.box(frame, {-0.22f, 0.47f, -0.22f}, {0.22f, 0.9f, -0.18f}, paint);
    for (const float x : {-0.2f, 0.16f})
        for (const float z : {-0.2f, 0.16f})
            b.box(frame, {x, 0, z}, {x + 0.04f, 0.43f, z + 0.04f}, paint);
}

} // namespace

Piece anyPiece(Builder& b)
{
    switch (b.anyOf(6)) {
    case 0:
        return {{b.between(0.9f, 1.4f), b.between(1.8f, 2.1f), 0.58f}, buildChest};
    case 1:
        return {{b.between(0.8f, 1.2f), b.between(1.3f, 2.0f), 0.32f}, buildShelf};
    case 2:
        return {{b.between(1.0f, 1.6f), 0.5f, 2.0f}, buildBed};
    case 3:
        return {{b.between(1.5f, 2.1f), 0.8f, 0.85f}, buildSofa};
    case 4:
        return {{b.between(1.1f, 1.6f), 0.74f, 0.7f}, buildTable};
    default:
        return {{b.between(0.8f, 1.5f), b.between(0.7f, 1.0f), 0.45f}, buildChest};
    }
}

Piece nightstand()
{
    return {{0.5f, 0.55f, 0.42f}, buildChest};
}

void buildFreePiece(Builder& b, const Frame& frame)
{
    switch (b.anyOf(3)) {
    case 0: {
        buildTable(b, frame.moved({0, 0, -0.4f}), {1.2f, 0.74f, 0.8f});
        const int paint = b.anyPaint(0.4f);
        for (const float side : {-1.0f, 1.0f})
            buildChair(b, frame.moved({0.1f * side, 0, 0.55f * side}, side > 0 ? 3.3f : 0.1f),
                       paint);
        return;
    }
    case 1:
        buildSofa(b, frame.moved({0, 0, -0.4f}), {0.9f, 0.8f, 0.8f});
        return;
    default:
        b.box(frame, {-0.3f, 0, -0.25f}, {0.3f, b.between(0.3f, 0.6f), 0.25f}, b.anyPaint(0.5f));
        return;
    }
}

} // namespace relamp::rooms
