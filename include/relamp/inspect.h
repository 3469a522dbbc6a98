#pragma once

#include "relamp/api.h"
#include "relamp/progress.h"
#include "relamp/scan.h"

#include <string>
#include <vector>

namespace relamp
{

/// One page of a scan in numbers.
struct PageInspection
{
    std::string name;
    int width = 0;
    int height = 0;
    bool ofVertices = false;
    double coverage = 0.0; // share of pixels that show a surface, 0..1
    double clipped = 0.0;  // share of covered texels with a channel at the top of its range, 0..1;
                           // 0 of a float texture, whose range has no top
    size_t charts = 0;     // connected pieces of its UV layout
};

/// Texels that stand for more than one place, by how these places are to each other: shares of all,
/// 0..1.
struct Overlap
{
    double tiled = 0.0;              // the texture starts anew beyond its edge
    double mirrored = 0.0;           // two places show one part of it, one of them turned over
    double copied = 0.0;             // two places show one part of it
    double opposite = 0.0;           // two surfaces within 2 cm of each other that face apart
    double alike = 0.0;              // likewise, facing alike: they get the same light
    std::vector<std::string> meshes; // that have most of them, five at most

    [[nodiscard]] double inOtherLight() const { return tiled + mirrored + copied + opposite; }
    [[nodiscard]] double share() const { return inOtherLight() + alike; }
};

/// What a scan is, and what delight will make of it.
struct Inspection
{
    size_t triangles = 0;
    size_t meshes = 0;
    size_t texels = 0;
    double squareMetres = 0.0;
    double millimetresPerTexel = 0.0;
    Bounds bounds;
    Overlap overlap;
    std::vector<PageInspection> pages;
    std::vector<std::string> problems; // a sentence each, with what to do about it
};

RELAMP_API Inspection inspect(const Scan& scan, Progress& progress = unwatched());

} // namespace relamp
