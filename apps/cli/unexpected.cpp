#include "unexpected.h"

#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

std::string sentenceOf(const std::exception& unexpected)
{
    if (dynamic_cast<const std::bad_alloc*>(&unexpected) != nullptr)
        return "this machine has not enough memory for the scan; scale its textures down";
    if (dynamic_cast<const std::length_error*>(&unexpected) != nullptr)
        return "a file asks for more memory than there is anywhere; it is damaged, or a number in "
               "it is wrong";
    if (const auto* of = dynamic_cast<const std::filesystem::filesystem_error*>(&unexpected))
        return fmt::format("{}: {}", of->path1().string(), of->code().message());
    if (const auto* of = dynamic_cast<const std::system_error*>(&unexpected))
        return fmt::format("the system refuses something: {}", of->code().message());
    return "relamp met something that it was not made for, and stopped; nothing half-written is "
           "left.\nPlease report it, with the command and the file that it was given";
}
