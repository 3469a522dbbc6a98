#pragma once

#include "scan/gltf_read.h"

namespace relamp
{

/// A glTF model of a scan that came in another format: a node, mesh and material a Mesh, an image
/// without content a textured page.
GltfSource gltfFromScan(const Scan& scan);

} // namespace relamp
