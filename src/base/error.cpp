#include "relamp/error.h"

#include "relamp/printable.h"

namespace relamp
{

Error::Error(ErrorCode code, const std::string& sentence)
    : std::runtime_error(printableText(sentence)), code_(code)
{}

} // namespace relamp
