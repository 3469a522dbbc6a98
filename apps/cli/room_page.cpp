#include "room_page.h"

#include "relamp/error.h"

#include <array>
#include <system_error>

#include <fmt/format.h>

std::filesystem::path pageViewer()
{
    const std::filesystem::path here =
        std::filesystem::read_symlink("/proc/self/exe").parent_path();
    const std::array<std::filesystem::path, 2> places{here / "../share/relamp/page",
                                                      here / "../web/page"};
    std::error_code ignored;
    for (const std::filesystem::path& place : places)
        if (std::filesystem::exists(place, ignored)) return place.lexically_normal();
    throw relamp::Error(relamp::ErrorCode::cannotRead,
                        fmt::format("{}: what a page runs in the browser is not there; it is made "
                                    "where Node.js and npm are: install them and build again",
                                    places.back().lexically_normal().string()));
}
