#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace relamp::malformed
{

/// A scan that is right in every way, and small: what it is called, what is in it, what lies
/// beside.
struct SmallScan
{
    std::string name;
    std::string bytes;
    std::map<std::string, std::string> beside;
};

/// A square as GLB with a PNG in it, as OBJ with material and JPEG, as coloured PLY in text and in
/// bytes; a triangle as PLY with a "png" or "jpeg" beside.
SmallScan smallGlb();
SmallScan smallObj();
SmallScan smallTextPly();
SmallScan smallBinaryPly();
SmallScan smallTexturedPly(const std::string& format);

/// 16 x 16 pixels, no two alike: "png" or "jpeg".
std::string smallPicture(const std::string& format);

/// `bytes` with one bit turned over.
std::string flipped(std::string bytes, size_t bit);

/// Up to `count` numbers below `end`, always the same for the same arguments.
std::vector<size_t> scattered(size_t count, size_t end);

} // namespace relamp::malformed
