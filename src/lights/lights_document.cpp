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

LightsDocument::LightsDocument(const std::filesystem::path& file)
    : LightsDocument(file.string(), textOf(file))
{}

LightsDocument::LightsDocument(std::string name, const std::string& text)
    : name_(std::move(name)), document_(parseJson(text, name_)), lines_(text)
{
    const JsonItem all = top();
    if (const nlohmann::json* format = all.find("format"); format != nullptr && *format != kFormat)
        all.refuse(fmt::format("its format is {}, this version reads \"{}\"", printable(*format),
                               kFormat),
                   "format");
}

} // namespace relamp
