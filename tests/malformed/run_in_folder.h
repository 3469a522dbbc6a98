#pragma once

#include "golden/program.h"
#include "malformed/small_scans.h"
#include "scenes/temporary_folder.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace relamp::malformed
{

/// Runs the real program in a folder of its own, and sees what it says and leaves behind.
class RunInFolder : public testing::Test
{
protected:
    void write(const SmallScan& scan) const;
    void write(const std::string& name, const std::string& bytes) const
    {
        folder.write(name, bytes);
    }

    /// `relamp delight FILE -o out` and `more`; it may take ten seconds, and no signal ends it.
    [[nodiscard]] golden::Outcome delight(const std::string& file,
                                          const std::vector<std::string>& more = {}) const;

    /// delight ends with 1, has said one sentence that begins with what it is about and holds
    /// `words`, and there is no more in the folder than before.
    void expectRefused(const std::string& file, const std::string& words,
                       const std::vector<std::string>& more = {}) const;

    /// delight writes a result, and has said `words`.
    void expectTaken(const std::string& file, const std::string& words = "") const;

    /// Either of the two: a result as a whole, or a sentence and nothing else.
    void expectResultOrSentence(const std::string& file) const;

    [[nodiscard]] std::vector<std::string> names() const;

    scenes::TemporaryFolder folder;
};

} // namespace relamp::malformed
