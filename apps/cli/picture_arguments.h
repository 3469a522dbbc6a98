#pragma once

#include "relamp/picture.h"

#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

enum class Show {
    relit,
    scan,  // the light of the scan itself
    albedo // no light, all surfaces as bright as they are
};

/// How bright a picture is to be.
struct Exposure
{
    bool automatic = false; // by what is in the picture
    float stops = 0.0f;     // more than that, or than the light itself
};

/// What a person wants to see, and from where.
struct PictureArguments
{
    relamp::PictureOptions options;   // but for its view
    std::optional<relamp::View> view; // none: what suits `show`
    std::optional<Exposure> exposure; // the same
    std::string camera = "auto";
    Show show = Show::relit;
    int turntable = 0; // frames; 0: none
    std::filesystem::path timeline;
    double framesPerSecond = 24.0;

    [[nodiscard]] bool isFilm() const { return turntable > 0 || !timeline.empty(); }
    /// A new light is exposed by itself and shown by AgX; what is in textures is shown as it is.
    [[nodiscard]] relamp::View viewOf(bool isTexture) const
    {
        return view.value_or(isTexture ? relamp::View::standard : relamp::View::agx);
    }
    [[nodiscard]] Exposure exposureOf(bool isTexture) const
    {
        return exposure.value_or(Exposure{.automatic = !isTexture});
    }
};

void addPictureArguments(CLI::App& command, PictureArguments& arguments);
