#pragma once

#include "image/burnt_out.shared.h"
