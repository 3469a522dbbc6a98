#include "picture_arguments.h"

#include "scan_arguments.h"

#include <map>

#include <fmt/format.h>

namespace
{

constexpr int kLargestSide = 16384;

/// Reads "1280x720"; what is wrong with it, or nothing.
std::string takeSize(const std::string& text, relamp::PictureOptions& options)
{
    const size_t x = text.find('x');
    int width = 0;
    int height = 0;
    const bool isSize = x != std::string::npos &&
                        CLI::detail::lexical_cast(text.substr(0, x), width) &&
                        CLI::detail::lexical_cast(text.substr(x + 1), height) && width >= 1 &&
                        height >= 1 && width <= kLargestSide && height <= kLargestSide;
    if (!isSize)
        return fmt::format("{} is no size; write it as 1280x720, up to {} a side", text,
                           kLargestSide);
    options.width = width;
    options.height = height;
    return "";
}

/// Reads "2", "auto" or "auto-0.5"; what is wrong with it, or nothing.
std::string takeExposure(const std::string& text, std::optional<Exposure>& exposure)
{
    constexpr float kMost = 32.0f;
    const std::string word = "auto";
    Exposure wanted{.automatic = text.starts_with(word)};
    const std::string stops = wanted.automatic ? text.substr(word.size()) : text;
    const bool isSigned = stops.starts_with('+') || stops.starts_with('-');
    const bool isExposure =
        (wanted.automatic && stops.empty()) ||
        ((!wanted.automatic || isSigned) && CLI::detail::lexical_cast(stops, wanted.stops) &&
         wanted.stops >= -kMost && wanted.stops <= kMost);
    if (!isExposure)
        return fmt::format(
            "{} is no exposure; write auto, auto+1, auto-0.5, or stops from {} to {}", text, -kMost,
            kMost);
    exposure = wanted;
    return "";
}

void addFilm(CLI::App& command, PictureArguments& arguments)
{
    const std::string group = "Films";
    command
        .add_option("--turntable", arguments.turntable,
                    "N frames of one turn: around itself inside the room, around the room outside")
        ->check(between(1, 9999))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--timeline", arguments.timeline,
                    "Light that changes: lights as keys in time (docs/guide/relighting.md)")
        ->type_name("FILE")
        ->group(group);
    command.add_option("--fps", arguments.framesPerSecond, "Frames a second of a video [24]")
        ->check(between(1, 240))
        ->type_name("N")
        ->group(group);
}

} // namespace

void addPictureArguments(CLI::App& command, PictureArguments& arguments)
{
    const std::map<std::string, Show> shows{
        {"relit", Show::relit}, {"scan", Show::scan}, {"albedo", Show::albedo}};
    const std::string group = "Pictures";
    relamp::PictureOptions& options = arguments.options;
    command
        .add_option("--camera", arguments.camera,
                    "auto, a number of the glTF file's own cameras, or a camera file [auto]")
        ->type_name("CAMERA")
        ->group(group);
    command.add_option("--size", "Pixels of a picture [1280x720]")
        ->check(
            CLI::Validator([&options](std::string& text) { return takeSize(text, options); }, ""))
        ->type_name("WxH")
        ->group(group);
    command
        .add_option("--view", arguments.view,
                    "How bright light is shown: agx, aces, standard (cut off at white) [agx; "
                    "standard with --show and --bake]")
        ->transform(oneOf<relamp::View>())
        ->type_name("NAME")
        ->group(group);
    command
        .add_option(
            "--exposure",
            "Stops that light is shown brighter than it is; auto: its log-average becomes "
            "middle grey, auto+1: a stop more; not in .exr [auto; 0 with --show and --bake]")
        ->check(CLI::Validator(
            [&arguments](std::string& text) { return takeExposure(text, arguments.exposure); }, ""))
        ->type_name("EV")
        ->group(group);
    command
        .add_option("--antialias", options.samples,
                    "Rays through a pixel, along each of its sides [2]")
        ->check(between(1, 16))
        ->type_name("N")
        ->group(group);
    command
        .add_option(
            "--show", arguments.show,
            "relit; or, for comparison, scan, the light it was scanned in, or albedo [relit]")
        ->transform(oneOf(shows))
        ->type_name("WHAT")
        ->group(group);
    addFilm(command, arguments);
}
