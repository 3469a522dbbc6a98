#include "read_room.h"

#include "relamp/picture.h"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

namespace
{

constexpr int kGlanceLength = 1024; // pixels of pages by which a good view is looked for
constexpr float kAway = 0.25f;      // of the room's diagonal, to a place that is turned around

bool isFolder(const std::filesystem::path& path)
{
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored);
}

float usualDistance(const ReadRoom& room)
{
    return kAway * glm::length(room.mesh->bounds.extent());
}

/// To look for a view, a coarse room with the light still on it will do.
std::shared_ptr<const relamp::DelitRoom> coarseRoom(const relamp::Scan& scan)
{
    auto room = std::make_shared<relamp::DelitRoom>();
    room->scan = std::make_shared<const relamp::Scan>(relamp::coarsened(scan, kGlanceLength));
    for (const relamp::Page& page : room->scan->pages) room->albedo.push_back(page.image);
    return room;
}

} // namespace

std::filesystem::path folderOf(const std::filesystem::path& path)
{
    return isFolder(path) ? path : path.parent_path();
}

ReadRoom readRoom(const std::filesystem::path& path, const relamp::ScanOptions& options,
                  const TextureLimits& limits, relamp::Progress& progress)
{
    ReadRoom room{.path = path};
    if (isFolder(path)) {
        room.solved = readSolved(path, options, limits, progress);
        room.scan = room.solved->room->scan;
        room.textures = std::move(room.solved->photos);
    } else {
        room.scan = std::make_shared<const relamp::Scan>(relamp::readScan(path, options, progress));
        room.textures = PageShrinker(*room.scan, limits).textures();
        room.solver = std::make_shared<RoomSolver>(room.scan, limits);
    }
    room.mesh = std::make_shared<const RoomMesh>(roomMesh(*room.scan));
    return room;
}

Outlook firstOutlook(const ReadRoom& room)
{
    if (!room.scan->cameras.empty())
        return {room.scan->cameras.front().camera, usualDistance(room)};
    const glm::vec3 low = room.mesh->bounds.low;
    const glm::vec3 extent = room.mesh->bounds.extent();
    const glm::vec3 eye = low + extent * glm::vec3(0.2f, 0.6f, 0.8f);
    const glm::vec3 way = low + extent * glm::vec3(0.75f, 0.4f, 0.2f) - eye;
    const float length = glm::length(way);
    return {{eye, length > 0.0f ? way / length : glm::vec3(0, 0, -1), {0, 1, 0}, 1.3f},
            usualDistance(room)};
}

Surroundings surroundingsOf(const ReadRoom& room, relamp::Progress& progress)
{
    const auto seen = room.solved ? room.solved->room : coarseRoom(*room.scan);
    const auto photographer = std::make_shared<const relamp::Photographer>(*seen, progress);
    Surroundings around;
    around.reach = std::make_shared<Reach>(
        [seen, photographer](glm::vec3 from, std::span<const glm::vec3> directions) {
            return photographer->distancesSeen(from, directions);
        },
        room.mesh->bounds);
    if (!room.scan->cameras.empty()) return around;
    const relamp::Camera camera = photographer->goodView();
    const float ahead = around.reach->ahead(camera.position, camera.forward);
    around.outlook = {camera, std::min(usualDistance(room), 0.5f * ahead)};
    return around;
}
