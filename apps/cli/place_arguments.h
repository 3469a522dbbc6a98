#pragma once

#include "relamp/gather.h"

#include <vector>

#include <CLI/CLI.hpp>

/// An option that names places, in metres, as often as a person likes.
CLI::Option& addPlaces(CLI::App& command, const char* name, std::vector<glm::vec3>& places,
                       const char* what);

/// An option that names two places at once, X,Y,Z:X,Y,Z, as often as a person likes.
CLI::Option& addPlaces(CLI::App& command, const char* name, std::vector<relamp::SamePaint>& same,
                       const char* what);
