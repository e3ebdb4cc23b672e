// A transfer on disk, so that the next program need not make it.
#pragma once

#include <optional>
#include <string>

#include "common/plan/surface_transfer.h"

namespace airlight {

// SHA-256 (hex) of all that the transfer is made of.
std::string transfer_content(const Scene&, int rays);

// Beside the file of the scene's largest mesh: MESH.DIGITS.transfer, with 16 digits of the content. Empty where no mesh is of a
// file.
std::string transfer_path(const Scene&, const std::string& content);

// Nothing where there is no such file, or one that is damaged, cut off, of another content or version: all of it is under a
// checksum.
std::optional<SurfaceTransfer> read_transfer(const std::string& path, const std::string& content, const Scene&);

// Appears under its name when it is complete. Throws as TemporaryFile does.
void write_transfer(const std::string& path, const std::string& content, const SurfaceTransfer&);

}  // namespace airlight
