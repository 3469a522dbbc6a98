#pragma once

#include "relamp/picture.h"

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

enum class Show {
    relit,
    scan,  // the light of the scan itself
    albedo // no light, all surfaces as bright as they are
};

/// What a person wants to see, and from where.
struct PictureArguments
{
    relamp::PictureOptions options;
    std::string camera = "auto";
    Show show = Show::relit;
    int turntable = 0; // frames; 0: none
    std::filesystem::path timeline;
    double framesPerSecond = 24.0;

    [[nodiscard]] bool isFilm() const { return turntable > 0 || !timeline.empty(); }
};

void addPictureArguments(CLI::App& command, PictureArguments& arguments);
