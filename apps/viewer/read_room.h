#pragma once

#include "reach.h"
#include "room_mesh.h"
#include "solving.h"

#include "relamp/camera.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

/// A scan, or a folder of relamp delight, as it was read.
struct ReadRoom
{
    std::filesystem::path path;
    std::shared_ptr<const relamp::Scan> scan;
    std::shared_ptr<const RoomMesh> mesh;
    std::vector<TexturePixels> textures; // the scan's own, one a page
    std::shared_ptr<RoomSolver> solver;  // none of a folder
    std::optional<Solved> solved;        // of a folder: what was found before
};

/// Throws relamp::Error as relamp::readScan and readSolved do.
ReadRoom readRoom(const std::filesystem::path& path, const relamp::ScanOptions& options,
                  const TextureLimits& limits, relamp::Progress& progress);

/// `path`, or where it lies if it is no folder.
std::filesystem::path folderOf(const std::filesystem::path& path);

/// Where to look from, and how far.
struct Outlook
{
    relamp::Camera camera;
    float distance = 1.0f; // m, to the place that is turned around
};

/// The first of the scan's own cameras, or a place somewhere inside.
Outlook firstOutlook(const ReadRoom& room);

/// What takes a while to find of a room.
struct Surroundings
{
    std::optional<Outlook> outlook; // a good one, where the scan has none
    std::shared_ptr<Reach> reach;
};
Surroundings surroundingsOf(const ReadRoom& room, relamp::Progress& progress);
