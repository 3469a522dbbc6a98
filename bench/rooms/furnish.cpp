#include "rooms/furnish.h"

#include "base/radiometry.shared.h"
#include "relight/photometry.h"
#include "rooms/builder.h"
#include "rooms/furniture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

namespace relamp::rooms
{
namespace
{

constexpr float kReveal = 0.2f; // m that a window lies behind its wall
constexpr float kDaylightKelvin = 7000.0f;

// Power of lamps in radiance * m^2 * sr; the exposure settles what it comes to.
constexpr float kPanelPower = 4.0f;
constexpr float kGlobePower = 3.0f;
constexpr float kDomePower = 4.0f;
constexpr float kTablePower = 1.2f;
constexpr float kSconcePower = 1.5f;

/// A part of the floor that is taken.
struct Footprint
{
    glm::vec3 low;
    glm::vec3 high;
};

Footprint around(glm::vec3 one, glm::vec3 other)
{
    return {glm::min(one, other), glm::max(one, other)};
}

struct Hole
{
    float left, right, bottom, top; // m, along the wall and up
};

class RoomMaker
{
public:
    explicit RoomMaker(const Plan& plan) : plan_(plan), b_(plan.seed) {}

    Room make();

private:
    [[nodiscard]] Frame wall(int i) const;
    [[nodiscard]] float widthOf(int i) const { return i % 2 == 0 ? plan_.size.x : plan_.size.z; }
    glm::vec3 radianceOf(float power, float area);

    void addShell();
    void addWall(int i, int paint);
    void addHole(int i, const Hole& hole, bool hasPane);
    void addCeilingLamps();
    void addSconces();
    void addPictures();
    void addFurniture();
    void addTableLamp(glm::vec3 foot);
    bool isFree(const Footprint& wanted) const;
    bool placeAtWall(const Piece& piece, glm::vec3& top);
    void placeFreely();

    const Plan& plan_;
    Builder b_;
    std::vector<Footprint> taken_;
    int lampPaint_ = 0;
    std::array<bool, 4> hasHole_{};
};

Frame RoomMaker::wall(int i) const
{
    const glm::vec3 size = plan_.size;
    switch (i) {
    case 0:
        return {};
    case 1:
        return {{size.x, 0, 0}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}};
    case 2:
        return {{size.x, 0, size.z}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
    default:
        return {{0, 0, size.z}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    }
}

glm::vec3 RoomMaker::radianceOf(float power, float area)
{
    const glm::vec3 colour = blackbodyColour(plan_.kelvin * b_.between(0.92f, 1.08f));
    return b_.between(0.7f, 1.3f) * power / (kPi * area) * colour;
}

void RoomMaker::addHole(int i, const Hole& hole, bool hasPane)
{
    hasHole_[static_cast<size_t>(i)] = true;
    const Frame frame = wall(i);
    const glm::vec3 x(hole.right - hole.left, 0, 0);
    const glm::vec3 y(0, hole.top - hole.bottom, 0);
    const glm::vec3 z(0, 0, kReveal);
    const glm::vec3 low(hole.left, hole.bottom, 0);
    const int white = b_.add({.first = glm::vec3(0.75f)});
    b_.panel(frame, low, -z, y, white);
    b_.panel(frame, low + x - z, z, y, white);
    b_.panel(frame, low, x, -z, white);
    b_.panel(frame, low + y - z, x, z, white);
    if (hasPane) {
        const glm::vec3 sky = plan_.daylight * blackbodyColour(kDaylightKelvin);
        b_.panel(frame, low - z, x, y, lampPaint_, b_.addLamp("window", sky));
    } else
        b_.room.openings.push_back({frame.at(low - z), frame.turned(x), frame.turned(y)});
}

/// A wall with a window in it where the plan still wants one.
void RoomMaker::addWall(int i, int paint)
{
    const Frame frame = wall(i);
    const float width = widthOf(i);
    const float height = plan_.size.y;
    const bool isGap = plan_.isOpenPlan && i == 0;
    const int windows = plan_.panes + plan_.openings;
    const int window = plan_.isOpenPlan ? i - 1 : i; // panes first, then openings
    if (!isGap && (window < 0 || window >= windows)) {
        b_.panel(frame, glm::vec3(0), {width, 0, 0}, {0, height, 0}, paint);
        return;
    }
    const float half = isGap ? 1.3f : std::min(0.9f, 0.3f * width);
    const float middle = width * b_.between(0.42f, 0.58f);
    const Hole hole{middle - half, middle + half, isGap ? 0.0f : 0.85f, isGap ? 2.3f : 2.1f};
    b_.panel(frame, glm::vec3(0), {hole.left, 0, 0}, {0, height, 0}, paint);
    b_.panel(frame, {hole.right, 0, 0}, {width - hole.right, 0, 0}, {0, height, 0}, paint);
    const glm::vec3 across(hole.right - hole.left, 0, 0);
    b_.panel(frame, {hole.left, hole.top, 0}, across, {0, height - hole.top, 0}, paint);
    if (hole.bottom > 0.0f) b_.panel(frame, {hole.left, 0, 0}, across, {0, hole.bottom, 0}, paint);
    addHole(i, hole, !isGap && window < plan_.panes);
    if (isGap) {
        taken_.push_back(around(frame.at({hole.left, 0, 0}), frame.at({hole.right, 0, 1.0f})));
    }
}

void RoomMaker::addShell()
{
    lampPaint_ = b_.add({.first = glm::vec3(0.6f)});
    const glm::vec3 size = plan_.size;
    const bool isTiled = plan_.name == "bathroom";
    const int walls = b_.add({.pattern = isTiled ? Paint::tiles : Paint::plain,
                              .first = b_.anyColour(plan_.brightness, isTiled ? 0.1f : 0.15f),
                              .second = glm::vec3(0.4f),
                              .size = 0.2f});
    const int accent = b_.add({.pattern = b_.anyOf(2) == 0 ? Paint::stripes : Paint::cloth,
                               .first = b_.anyColour(0.8f * plan_.brightness, 0.5f),
                               .second = b_.anyColour(0.6f * plan_.brightness, 0.4f),
                               .size = 0.3f});
    const int accentWall = b_.anyOf(4);
    for (int i = 0; i < 4; ++i) addWall(i, i == accentWall ? accent : walls);
    constexpr std::array kFloors{Paint::planks, Paint::tiles, Paint::checks, Paint::cloth};
    const glm::vec3 wood = b_.anyColour(0.45f, 0.45f);
    const int floor = b_.add({.pattern = kFloors[static_cast<size_t>(b_.anyOf(4))],
                              .first = wood,
                              .second = 0.55f * wood,
                              .size = b_.between(0.15f, 0.35f),
                              .seed = plan_.seed});
    const int ceiling = b_.add({.first = glm::vec3(std::min(plan_.brightness + 0.1f, 0.85f))});
    b_.panel({}, {0, 0, size.z}, {size.x, 0, 0}, {0, 0, -size.z}, floor);
    b_.panel({}, {0, size.y, 0}, {size.x, 0, 0}, {0, 0, size.z}, ceiling);
    const glm::vec3 sky = plan_.daylight * blackbodyColour(kDaylightKelvin);
    b_.room.outside = plan_.isOpenPlan // another room, lit like this one, but dimly
                          ? Outside{glm::vec3(0.06f), glm::vec3(0.06f), glm::vec3(0.03f)}
                          : Outside{sky, glm::vec3(plan_.daylight), 0.3f * sky};
}

void RoomMaker::addCeilingLamps()
{
    const glm::vec3 size = plan_.size;
    const int frame = b_.add({.first = glm::vec3(0.5f)});
    constexpr glm::vec3 kPanel{0.6f, 0.03f, 0.6f};
    const glm::vec3 panelRadiance = radianceOf(kPanelPower, kPanel.x * kPanel.z);
    for (int i = 0; i < plan_.panels.x; ++i)
        for (int j = 0; j < plan_.panels.y; ++j) {
            const glm::vec2 at = (glm::vec2(i, j) + 0.5f) / glm::vec2(plan_.panels);
            const Frame place{.origin = {at.x * size.x, size.y - kPanel.y, at.y * size.z}};
            const glm::vec3 low = -0.5f * glm::vec3(kPanel.x, 0, kPanel.z);
            b_.box(place, low, low + kPanel, frame, allButTop);
            Patch& bottom = b_.room.patches.back(); // the last face of a box
            bottom.lamp = b_.addLamp("panel", panelRadiance);
            bottom.paint = lampPaint_;
        }
    constexpr float kRadius = 0.14f; // m
    for (int i = 0; i < plan_.globes; ++i) {
        const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(plan_.globes);
        const glm::vec3 top(along * size.x, size.y, size.z * b_.between(0.4f, 0.6f));
        const glm::vec3 centre = top - glm::vec3(0, 0.5f, 0);
        const float area = 4.0f * kPi * kRadius * kRadius;
        b_.box({.origin = centre}, {-0.01f, kRadius - 0.005f, -0.01f}, {0.01f, 0.5f, 0.01f}, frame,
               allButTop);
        b_.sphere(centre, kRadius, lampPaint_, b_.addLamp("globe", radianceOf(kGlobePower, area)));
    }
    for (int i = 0; i < plan_.domes; ++i) {
        const float along = (static_cast<float>(i) + 0.5f) / static_cast<float>(plan_.domes);
        const Frame place{
            .origin = {along * size.x, size.y - 0.09f, size.z * b_.between(0.4f, 0.6f)}};
        constexpr float kArea = 0.36f * 0.36f + 4.0f * 0.36f * 0.09f;
        b_.box(place, {-0.18f, 0, -0.18f}, {0.18f, 0.09f, 0.18f}, lampPaint_, allButTop,
               b_.addLamp("dome", radianceOf(kDomePower, kArea)));
    }
}

void RoomMaker::addSconces()
{
    int i = 3;
    for (int n = 0; n < plan_.sconces; ++n, --i) {
        while (hasHole_[static_cast<size_t>(i)]) --i;
        const Frame place = wall(i).moved({widthOf(i) * b_.between(0.3f, 0.7f), 1.7f, 0.0f});
        constexpr float kArea = 0.14f * 0.26f + 2.0f * 0.1f * (0.14f + 0.26f);
        b_.box(place, {-0.07f, 0, 0}, {0.07f, 0.26f, 0.1f}, lampPaint_, allButBack,
               b_.addLamp("sconce", radianceOf(kSconcePower, kArea)));
        taken_.push_back(around(place.at({-0.3f, 0, 0}), place.at({0.3f, 0, 0.6f})));
    }
}

void RoomMaker::addPictures()
{
    for (int i = 0; i < 4; ++i) {
        if (hasHole_[static_cast<size_t>(i)]) continue;
        const float x = widthOf(i) * (b_.anyOf(2) == 0 ? 0.2f : 0.8f);
        const float half = b_.between(0.2f, 0.3f);
        const int paint = b_.add({.pattern = Paint::blotches,
                                  .size = b_.between(0.1f, 0.2f),
                                  .seed = static_cast<uint64_t>(b_.anyOf(1000))});
        b_.box(wall(i).moved({x, 1.5f, 0}), {-half, -0.25f, 0}, {half, 0.25f, 0.02f}, paint,
               allButBack);
    }
}

bool RoomMaker::isFree(const Footprint& wanted) const
{
    const glm::vec3 size = plan_.size;
    if (wanted.low.x < -1e-3f || wanted.low.z < -1e-3f || wanted.high.x > size.x + 1e-3f ||
        wanted.high.z > size.z + 1e-3f)
        return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const Footprint& other) {
        return wanted.low.x < other.high.x && wanted.high.x > other.low.x &&
               wanted.low.z < other.high.z && wanted.high.z > other.low.z;
    });
}

/// Whether there was a place; `top` is then the middle of what is on top of the piece.
bool RoomMaker::placeAtWall(const Piece& piece, glm::vec3& top)
{
    constexpr int kTries = 30;
    constexpr float kApart = 0.04f; // m
    for (int n = 0; n < kTries; ++n) {
        const int i = b_.anyOf(4);
        const float half = 0.5f * piece.size.x + kApart;
        if (widthOf(i) < 2.0f * half) continue;
        if (hasHole_[static_cast<size_t>(i)] && piece.size.y > 0.8f) continue;
        const Frame frame = wall(i).moved({b_.between(half, widthOf(i) - half), 0, 0});
        const Footprint wanted =
            around(frame.at({-half, 0, 0}), frame.at({half, piece.size.y, piece.size.z + kApart}));
        if (!isFree(wanted)) continue;
        taken_.push_back(wanted);
        piece.build(b_, frame, piece.size);
        top = frame.at({0, piece.size.y, 0.5f * piece.size.z});
        return true;
    }
    return false;
}

void RoomMaker::placeFreely()
{
    constexpr int kTries = 20;
    constexpr glm::vec3 kHalf{0.9f, 0, 0.9f};
    for (int n = 0; n < kTries; ++n) {
        const glm::vec3 at(b_.between(0, plan_.size.x), 0, b_.between(0, plan_.size.z));
        if (!isFree({at - kHalf, at + kHalf})) continue;
        taken_.push_back({at - kHalf, at + kHalf});
        const Frame frame = Frame{.origin = at}.moved({}, b_.between(0, 2.0f * kPi));
        b_.box(frame, {-0.85f, 0, -0.6f}, {0.85f, 0.01f, 0.6f}, b_.anyPaint(0.4f)); // a rug
        buildFreePiece(b_, frame.moved({0, 0.01f, 0}));
        return;
    }
}

void RoomMaker::addTableLamp(glm::vec3 foot)
{
    const Frame frame = Frame{.origin = foot}.moved({}, b_.between(0, 1.5f));
    const int metal = b_.add({.first = glm::vec3(0.3f)});
    b_.box(frame, {-0.07f, 0, -0.07f}, {0.07f, 0.02f, 0.07f}, metal);
    b_.box(frame, {-0.015f, 0.02f, -0.015f}, {0.015f, 0.22f, 0.015f}, metal);
    constexpr float kArea = 2.0f * 0.24f * 0.24f + 4.0f * 0.24f * 0.2f;
    b_.box(frame, {-0.12f, 0.22f, -0.12f}, {0.12f, 0.42f, 0.12f}, lampPaint_, allFaces,
           b_.addLamp("shade", radianceOf(kTablePower, kArea)));
}

void RoomMaker::addFurniture()
{
    glm::vec3 top(0.0f);
    for (int i = 0; i < plan_.tableLamps; ++i)
        if (placeAtWall(nightstand(), top)) addTableLamp(top);
    for (int i = 0; i < plan_.furniture; ++i) {
        if (i % 3 == 2)
            placeFreely();
        else
            placeAtWall(anyPiece(b_), top);
    }
}

Room RoomMaker::make()
{
    addShell();
    addCeilingLamps();
    addSconces();
    addPictures();
    addFurniture();
    return std::move(b_.room);
}

} // namespace

Room furnish(const Plan& plan)
{
    return RoomMaker(plan).make();
}

} // namespace relamp::rooms
