#include "text_file.h"

#include "relamp/error.h"

#include <fstream>

#include <fmt/format.h>

namespace
{

constexpr size_t kLargestText = size_t{16} << 20; // bytes

} // namespace

std::string textFrom(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::string text;
    char part[4096];
    while (in.read(part, sizeof(part)) || in.gcount() > 0) {
        text.append(part, static_cast<size_t>(in.gcount()));
        if (text.size() > kLargestText) break;
    }
    if (!in.eof())
        throw relamp::Error(relamp::ErrorCode::cannotRead,
                            fmt::format("{}: cannot be read", file.string()));
    return text;
}

/// Whole or not at all.
void writeText(const std::filesystem::path& file, const std::string& text)
{
    const std::filesystem::path staged = file.string() + ".part";
    std::error_code failure;
    {
        std::ofstream out(staged, std::ios::binary);
        out << text;
        out.close();
        if (!out) failure = std::make_error_code(std::errc::io_error);
    }
    if (!failure) std::filesystem::rename(staged, file, failure);
    if (!failure) return;
    std::error_code ignored;
    std::filesystem::remove(staged, ignored);
    throw relamp::Error(relamp::ErrorCode::cannotWrite,
                        fmt::format("{}: cannot be written; choose another place", file.string()));
}
