#include "lights/lights_document.h"

#include "base/file.h"
#include "base/json.h"

namespace relamp
{
namespace
{

constexpr size_t kLargestFile = size_t{16}
                                << 20; // bytes; a thousand lights take a quarter of one MiB

std::string textOf(const std::filesystem::path& file)
{
    const std::vector<std::byte> bytes = readFile(file, kLargestFile);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

} // namespace

LightsDocument::LightsDocument(const std::filesystem::path& file, const char* format)
    : LightsDocument(file.string(), textOf(file), format)
{}

LightsDocument::LightsDocument(std::string name, const std::string& text, const char* format)
    : name_(std::move(name)), document_(parseJson(text, name_)), lines_(text)
{
    const JsonItem all = top();
    if (const nlohmann::json* found = all.find("format"); found != nullptr && *found != format)
        all.refuse(
            fmt::format("its format is {}, this version reads \"{}\"", printable(*found), format),
            "format");
}

} // namespace relamp
