#include "command.h"

#include "relamp/error.h"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace
{

/// The viewer is a program of its own, so that all else runs where there is nothing to draw with.
constexpr const char* kProgram = "relamp-view";

/// Where the viewer lies: beside this program, or where a build folder has it.
std::filesystem::path viewerFile()
{
    const std::filesystem::path here =
        std::filesystem::read_symlink("/proc/self/exe").parent_path();
    std::error_code ignored;
    for (const std::filesystem::path& file : {here / kProgram, here / "../viewer" / kProgram})
        if (std::filesystem::exists(file, ignored)) return file;
    throw relamp::Error(relamp::ErrorCode::cannotRead,
                        fmt::format("{} is not there; it is installed with relamp's viewer",
                                    (here / kProgram).string()));
}

/// The viewer would not even start without these, and could not say why.
void checkLibraries()
{
    struct Needed
    {
        const char* library;
        const char* what;
        const char* package;
    };
    constexpr std::array<Needed, 2> kNeeded{{{"libvulkan.so.1", "the Vulkan loader", "libvulkan1"},
                                             {"libglfw.so.3", "GLFW", "libglfw3"}}};
    for (const Needed& needed : kNeeded) {
        void* found = dlopen(needed.library, RTLD_LAZY);
        if (found == nullptr)
            throw relamp::Error(relamp::ErrorCode::unsupported,
                                fmt::format("the viewer needs {} ({}); install the package {}",
                                            needed.what, needed.library, needed.package));
        dlclose(found);
    }
}

int run(const std::vector<std::string>& arguments)
{
    const std::string file = viewerFile().string();
    checkLibraries();
    std::vector<char*> words{const_cast<char*>(file.c_str())};
    for (const std::string& argument : arguments)
        words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    execv(file.c_str(), words.data());
    throw relamp::Error(relamp::ErrorCode::cannotRead,
                        fmt::format("{}: cannot be started: {}", file, std::strerror(errno)));
}

} // namespace

void addViewCommand(CLI::App& app, Run& run)
{
    CLI::App& command = *app.add_subcommand(
        "view", "Look at a room, take its light out and put up lamps, in a window");
    command.set_help_flag(); // the viewer has its own, and its own arguments
    command.prefix_command();
    command.callback(
        [&command, &run] { run = [arguments = command.remaining()] { return ::run(arguments); }; });
}
