#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relamp::scenes
{

/// A folder of its own that goes with the object.
class TemporaryFolder
{
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const
    {
        return path_ / name;
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Both return where the file is.
    std::filesystem::path write(const std::string& name, const std::string& text) const;
    std::filesystem::path write(const std::string& name, const std::vector<uint8_t>& bytes) const;

private:
    std::filesystem::path path_;
};

} // namespace relamp::scenes
