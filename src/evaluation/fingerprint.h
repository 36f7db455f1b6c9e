#pragma once

#include <string>
#include <vector>

namespace grasp_affordances
{

/// 16 hexadecimal digits that differ where the content of a file or of a text does (FNV-1a, 64 bits): against mistakes,
/// not against malice. @throw std::runtime_error for a file that cannot be read
std::string fingerprintOfText(const std::string& text);
std::string fingerprintOfFiles(const std::vector<std::string>& paths);

/// Of the running program and the libraries of this package that it has loaded.
std::string fingerprintOfCode();

}  // namespace grasp_affordances
