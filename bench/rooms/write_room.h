#pragma once

#include "rooms/bake.h"
#include "rooms/photograph.h"
#include "rooms/plans.h"

#include <filesystem>

namespace relamp::rooms
{

/// A room that has been baked.
struct FinishedRoom
{
    Plan plan;
    Room room;
    Atlas atlas;
    Baked baked;
    Photograph photo;
};

/// Writes scan.glb and the truth: gt_albedo.exr, gt_shading.exr = gt_direct.exr + gt_indirect.exr
/// in the texture's units, mask.png, gt_lights.json, meta.json.
void writeRoom(const FinishedRoom& room, const std::filesystem::path& folder);

/// The same of a mesh as photogrammetry makes them, with a JPEG: scan_recon.glb, scan_recon.jpg.
void writeReconstruction(const FinishedRoom& room, const std::filesystem::path& folder);

/// What a test needs: scan.glb, gt_albedo.png, black where nothing is scored, gt_lights.json.
void writeSmall(const FinishedRoom& room, const std::filesystem::path& folder);

} // namespace relamp::rooms
