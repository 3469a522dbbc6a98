#pragma once

#include "edit.h"
#include "room_mesh.h"
#include "solving.h"

#include "relamp/relight.h"
#include "relamp/timeline.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// How far a room has been taken apart.
enum class Stage { nothing, reading, scanned, drafted, solved };

/// The room that is open: all that changes at once when another is adopted.
struct OpenRoom
{
    std::filesystem::path path;
    std::shared_ptr<const relamp::Scan> scan;
    std::shared_ptr<const RoomMesh> mesh;
    std::shared_ptr<RoomSolver> solver; // of the thread that solves
    SolverParameters solvedBy;          // it is, or is on the way to be
    Stage stage = Stage::nothing;
    relamp::Lights captured; // by which the albedo was found
    relamp::Lights found;    // before anybody said how it was on the day of the scan
    std::shared_ptr<const relamp::Decomposition> decomposition;
    std::optional<relamp::Closure> closure;
    std::vector<std::string> notes;               // on the solution, that were told
    std::optional<double> reevaluateMilliseconds; // until albedo followed, the last time

    std::filesystem::path lightsFolder; // where files lie that the light names
    relamp::RelightingReader reader;    // of these files
    bool isLightOfScan = true;          // as the room's own

    std::optional<relamp::Timeline> timeline;
    bool isPlaying = false;
    double part = 0.0; // of the timeline, 0..1
};
