#pragma once

#include "relamp/scan.h"

namespace relamp
{

/// Gives every mesh without a texture its place on one page of vertices, behind the textured pages.
///
/// Such meshes have `page` -1 when this is called; their colour is `factor` times `colors` (white
/// where there are none). `transfer` says what the colours are; automatic leaves them as they are.
/// Throws Error(unsupported), naming `file`, where no mesh has either texture or colours.
void addVertexPage(Scan& scan, Transfer transfer, const std::string& file);

} // namespace relamp
