#include "scan/scan_folder.h"

#include "relamp/error.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

namespace relamp
{

ScanFolder::ScanFolder(const std::filesystem::path& scanFile, const ScanOptions& options)
    : folder_(scanFile.parent_path()), allowOutside_(options.allowOutside)
{
    std::error_code ignored; // of a folder that is not there nothing can be read
    real_ = std::filesystem::canonical(folder_.empty() ? "." : folder_, ignored);
    realScan_ = std::filesystem::canonical(scanFile, ignored);
}

bool ScanFolder::holds(const std::filesystem::path& file) const
{
    // The system ends a name at such a character, and so would look for another file than this.
    if (file.native().find('\0') != std::string::npos) return false;
    if (allowOutside_) return true;
    std::error_code failure;
    const std::filesystem::path real =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, failure), failure);
    if (failure || real_.empty()) return false;
    return real == realScan_ ||
           std::mismatch(real_.begin(), real_.end(), real.begin(), real.end()).first == real_.end();
}

void ScanFolder::refuse(const std::string& who, const std::string& named)
{
    throw Error(
        ErrorCode::unsupported,
        fmt::format("{} names the file \"{}\", which lies outside of the scan's folder.\n"
                    "A stranger's scan could carry off any file so. Copy it into the folder, or "
                    "say --allow-outside if you trust the scan.",
                    who, named));
}

} // namespace relamp
