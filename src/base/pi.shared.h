#ifndef RELAMP_PI_SHARED_H
#define RELAMP_PI_SHARED_H

#include "base/shared.h"

SHARED_BEGIN

SHARED_CONST kPi = 3.14159265f;

SHARED_END

#endif
