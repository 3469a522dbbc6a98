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

/// What a scan is, and what delight will make of it.
struct Inspection
{
    size_t triangles = 0;
    size_t meshes = 0;
    size_t texels = 0;
    double squareMetres = 0.0;
    double millimetresPerTexel = 0.0;
    Bounds bounds;
    double overlapShare = 0.0; // of texels that stand for several places, 0..1
    std::vector<PageInspection> pages;
    std::vector<std::string> problems; // a sentence each, with what to do about it
};

RELAMP_API Inspection inspect(const Scan& scan, Progress& progress);

} // namespace relamp
