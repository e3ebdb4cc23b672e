// A transfer on disk, so that the next program need not make it.
#pragma once

#include <optional>
#include <string>

#include "common/plan/surface_transfer.h"

namespace airlight {

// SHA-256 (hex) of all that the transfer is made of.
std::string transfer_content(const Scene&, int rays);

// DIGITS.transfer, with 16 digits of the content, in $XDG_CACHE_HOME/airlight, or ~/.cache/airlight where that is not set or not
// absolute. Empty where there is no home either.
std::string transfer_path(const std::string& content);

// Nothing where there is no such file, or one that is damaged, cut off, of another content or version: all of it is under a
// checksum.
std::optional<SurfaceTransfer> read_transfer(const std::string& path, const std::string& content, const Scene&);

// Appears under its name when it is complete; its folder is made. Throws as TemporaryFile does.
void write_transfer(const std::string& path, const std::string& content, const SurfaceTransfer&);

}  // namespace airlight
