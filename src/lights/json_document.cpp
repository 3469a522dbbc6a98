#include "lights/json_document.h"

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

JsonDocument::JsonDocument(const std::filesystem::path& file, const char* format)
    : JsonDocument(file.string(), textOf(file), format)
{}

JsonDocument::JsonDocument(std::string name, const std::string& text, const char* format)
    : name_(std::move(name)), document_(parseJson(text, name_)), lines_(text)
{
    const JsonItem all = top();
    if (format == nullptr) return;
    if (const nlohmann::json* found = all.find("format"); found != nullptr && *found != format)
        all.refuse(
            fmt::format("its format is {}, this version reads \"{}\"", printable(*found), format),
            "format");
}

} // namespace relamp
