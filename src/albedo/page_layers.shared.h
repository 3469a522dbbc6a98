#ifndef RELAMP_PAGE_LAYERS_SHARED_H
#define RELAMP_PAGE_LAYERS_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

// A lamp's own glass cannot be seen for its light; confidence says so.
SHARED_CONST kAlbedoOfFixtures = 0.6f;

SHARED_END

#endif
