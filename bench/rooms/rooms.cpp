// Makes furnished rooms whose albedo, light and lamps are known; docs/dev/rooms.md.

#include "rooms/furnish.h"
#include "rooms/write_room.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace
{

using namespace relamp::rooms;

struct Wanted
{
    std::string folder;
    std::vector<std::string> names; // none: all
    int side = 512;                 // pixels
    BakeOptions bake;
    bool isSmall = false;
};

void make(const Plan& plan, const Wanted& wanted)
{
    const auto start = std::chrono::steady_clock::now();
    FinishedRoom made{.plan = plan, .room = furnish(plan)};
    made.atlas = layOut(made.room, wanted.side);
    made.baked = bake(made.room, made.atlas, wanted.bake);
    made.photo = photograph(made.atlas, made.baked, plan.burntOut);
    const std::filesystem::path folder = std::filesystem::path(wanted.folder) / plan.name;
    if (wanted.isSmall)
        writeSmall(made, folder);
    else {
        writeRoom(made, folder);
        writeReconstruction(made, folder / "recon");
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    fmt::print("{}: {} lamps, {} charts, {:.1f} s\n", plan.name, made.room.lamps.size(),
               made.atlas.charts.size(), seconds.count());
}

} // namespace

int main(int argc, char** argv)
{
    CLI::App app("Makes rooms with ground truth, each in a folder of its name.");
    Wanted wanted;
    std::vector<std::string> names;
    for (const Plan& plan : allPlans()) names.push_back(plan.name);
    app.add_option("folder", wanted.folder, "Where the rooms' folders go")->required();
    app.add_option("rooms", wanted.names, "Names; none: all of plans.cpp")
        ->check(CLI::IsMember(names));
    app.add_option("--side", wanted.side, "Pixels of a texture's side")
        ->check(CLI::Range(64, 8192));
    app.add_option("--lamp-rays", wanted.bake.lampRays, "A texel and lamp")
        ->check(CLI::Range(1, 4096));
    app.add_option("--bounce-rays", wanted.bake.bounceRays, "A texel")->check(CLI::Range(1, 4096));
    app.add_flag("--small", wanted.isSmall, "Only what tests/rooms keeps");
    CLI11_PARSE(app, argc, argv);
    try {
        for (const Plan& plan : allPlans())
            if (wanted.names.empty() ||
                std::count(wanted.names.begin(), wanted.names.end(), plan.name))
                make(plan, wanted);
    } catch (const std::exception& error) {
        fmt::print(stderr, "relamp_rooms: {}\n", error.what());
        return 1;
    }
    return 0;
}
