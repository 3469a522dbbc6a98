#pragma once

#include "relamp/api.h"
#include "relamp/camera.h"
#include "relamp/relight.h"
#include "relamp/replacing.h"
#include "relamp/timeline.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relamp
{

struct PageOptions
{
    std::filesystem::path viewer; // folder of what runs in the browser, as relamp installs it
    DelitOptions scan;            // where the scan is, which the page shows as it was
    std::optional<Camera> camera; // where a visitor begins; none: Photographer::goodView
    int side = 0;                 // pixels of a lightmap along a side, at most; 0: by their number
    const Timeline* timeline = nullptr; // that a visitor goes along; it dims and colours the lights
    Replacing replacing = Replacing::unchanged;
};

struct WrittenPage
{
    uint64_t bytes = 0;             // of all files
    size_t lights = 0;              // that can be switched
    std::vector<std::string> notes; // what the page lacks, a sentence each
};

/// Throws Error(cannotWrite) where writePage could not write into `folder`, or would replace what
/// it may not, and Error(cannotRead) where the viewer is not there. Worth asking before work that
/// takes long.
RELAMP_API void checkPage(const std::filesystem::path& folder, const PageOptions& options);

/// Throws Error(unsupported) where a page cannot show such a scan: one of colours of vertices.
RELAMP_API void checkPage(const Scan& scan);

/// Writes a page for browsers that shows the room, described in docs/guide/page.md, into `folder`:
/// whole or not at all. It has the room as it was scanned, its albedo, and a lightmap of each light
/// of `lighting` (partsOf), which the browser adds up. Leaves the relighter under the last of them.
/// Throws Error(cannotWrite | cannotRead | cancelled), and Error(unsupported) where no light is on
/// or checkPage() refuses the scan, or the timeline has other lights than `lighting`.
RELAMP_API WrittenPage writePage(Relighter& relighter, const Relighting& lighting,
                                 const std::filesystem::path& folder, const PageOptions& options,
                                 Progress& progress = unwatched());

} // namespace relamp
