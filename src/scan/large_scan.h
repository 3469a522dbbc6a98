#pragma once

#include "relamp/scan.h"

#include <cstdint>

namespace relamp
{

/// Pixels of all pages together up to which a scan stays in memory: 2^26, one page of
/// 8192 x 8192; or what RELAMP_PIXELS_IN_MEMORY says. Beyond, pages and their texels lie in
/// temporary files while nobody reads them, and what looks at places anywhere in the room keeps
/// only as many of them as it needs.
uint64_t pixelsInMemory();

/// Pixels of all pages.
uint64_t pixelsOf(const Scan& scan);

/// Whether a scan has more than stay in memory.
bool isLarge(const Scan& scan);

/// Moves a page's picture to a file; false where it stays in memory.
bool spillPage(const Page& page);
/// All of it is read soon.
void willNeed(const Page& page);
/// A page that spillPage() said true for, and that is as it was, is not read for a while.
void letGo(const Page& page);

} // namespace relamp
