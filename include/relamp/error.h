#pragma once

#include "relamp/api.h"

#include <stdexcept>
#include <string>

namespace relamp
{

enum class ErrorCode {
    cannotRead,   // the file is missing, unreadable, or no file at all
    malformed,    // the bytes break the rules of their format
    unsupported,  // well formed, but not something relamp can work on
    cannotWrite,  // the place for the result refuses it
    sizeMismatch, // two inputs that must have the same shape do not
    cancelled,    // Progress::cancel was called
    device        // there is no GPU as asked for, or it gave up
};

/// The world is not as it must be: a file, an option, a disk.
///
/// `what()` is a sentence for the person at the keyboard. It names the file, the thing in it, and
/// the way out, and may be printed whatever the file has in its names (relamp/printable.h).
/// Mistakes of the programmer are assertions, never an Error.
class RELAMP_API Error : public std::runtime_error
{
public:
    Error(ErrorCode code, const std::string& sentence);

    [[nodiscard]] ErrorCode code() const { return code_; }

private:
    ErrorCode code_;
};

} // namespace relamp
