#include "scenes/solved.h"

#include "shading/enclosed_texels.h"
#include "solve/find_room.h"

#include <utility>

namespace relamp::scenes
{
namespace
{

Texels texelsOf(const Scan& scan, const RayScene& scene)
{
    Progress progress;
    Texels texels = rasterizeAtlas(scan, progress, surfelsOf({.quality = Quality::draft}));
    separateEnclosed(texels, scene, progress);
    return texels;
}

SolvedRoom solvedOf(const Texels& texels, const RayScene& scene)
{
    Progress progress;
    DelightOptions options;
    options.gather.quality = Quality::draft;
    return solvedRoom(texels, scene, findRoom(texels, scene, options, progress));
}

} // namespace

Solved::Solved(Scan theScan)
    : scan(std::move(theScan)), scene(scan), texels(texelsOf(scan, scene)),
      solved(solvedOf(texels, scene))
{}

} // namespace relamp::scenes
