#pragma once

#include "output/preview.h"
#include "relamp/camera_model.h"

namespace relamp
{

/// Draws into the lower left corner of a preview's first picture what a camera did: radiance over
/// what the texture shows, both in stops below white, black and white at the corners. Grey: a
/// camera that does nothing; white: the response; amber around it: how far that is shifted, by gain
/// and local tone mapping, from one end of the room to the other. Of a neutral camera nothing is
/// drawn.
void drawCamera(const CameraModel& camera, PreviewPicture& picture);

} // namespace relamp
