#include "scenes/temporary_folder.h"

#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace relamp::scenes
{

TemporaryFolder::TemporaryFolder()
{
    std::string pattern = (std::filesystem::temp_directory_path() / "relamp-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
        throw std::runtime_error("cannot make a temporary folder");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TemporaryFolder::write(const std::string& name, const std::string& text) const
{
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
}

std::filesystem::path TemporaryFolder::write(const std::string& name,
                                             const std::vector<uint8_t>& bytes) const
{
    return write(name, std::string(bytes.begin(), bytes.end()));
}

} // namespace relamp::scenes
