#pragma once

#include "relamp/error.h"

#include <filesystem>
#include <string>

#include <fmt/format.h>

namespace relamp
{

/// Throws Error(code, "what: why"); `what` names the file and the part of it.
[[noreturn]] inline void fail(ErrorCode code, const std::string& what, const std::string& why)
{
    throw Error(code, fmt::format("{}: {}", what, why));
}

[[noreturn]] inline void malformed(const std::string& what, const std::string& why)
{
    fail(ErrorCode::malformed, what, why);
}

[[noreturn]] inline void cannotWrite(const std::filesystem::path& file, const std::string& why)
{
    fail(ErrorCode::cannotWrite, file.string(), "cannot be written: " + why);
}

} // namespace relamp
