#pragma once
/// Numbers of fields as text.

#include <string>
#include <string_view>

#include "export/fields.h"

namespace talus {

/// Appends the shortest decimal that reads back as the same number, in single precision where the field has
/// no more; `nan` for a number that is none.
void append_number(std::string& text, double value, FieldNumber number, std::string_view nan = "nan");

}  // namespace talus
