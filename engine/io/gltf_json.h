// Reading glTF JSON with a reason for every refusal. Internal to engine/io: refuse() throws, read_scene() catches.
#pragma once

#include "engine/base/math.h"
#include "engine/base/result.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace atrium::gltf {

using Json = nlohmann::json;

/// Thrown by refuse(); read_scene() turns it into its Result. Never leaves engine/io.
struct Refusal {
    Error error;
};
[[noreturn]] void refuse(std::string where, std::string what, std::string hint = {});

/// "nodes/3 (Chair)": how messages name an element of a top-level array.
std::string place(const Json& root, const char* section, std::size_t index);

/// Member of an object; null when it is absent.
const Json* find(const Json& object, const char* key);
/// Member that must be an object when it is there.
const Json* find_object(const Json& object, const char* key, const std::string& where);
/// Member that must be an array when it is there.
const Json* find_array(const Json& object, const char* key, const std::string& where);
/// object.extensions[name], or null.
const Json* find_extension(const Json& object, const char* name);
/// Elements of a top-level array; an empty array when the section is absent.
const Json& section(const Json& root, const char* key);

/// Numbers and texts with a default; refused when they are of another type.
double number(const Json& object, const char* key, double fallback, const std::string& where);
vec3 number3(const Json& object, const char* key, const vec3& fallback, const std::string& where);
bool boolean(const Json& object, const char* key, bool fallback, const std::string& where);
std::string text(const Json& object, const char* key, const std::string& where);
/// Whole number in [least, most]; refused otherwise. A float without fraction (44.0) counts as whole.
std::uint64_t whole(const Json& value, std::uint64_t least, std::uint64_t most, const std::string& where);
/// Index into an array of `count` elements; -1 when absent.
int index(const Json& object, const char* key, std::size_t count, const std::string& where);

/// JSON text of the member, as extras are kept; empty when absent.
std::string json_text(const Json& object, const char* key);
/// The JSON number that reads back as exactly this float, in as few digits as possible (0.8, not 0.800000011920929).
Json short_number(float value);
Json short_numbers(const vec3& value);

} // namespace atrium::gltf
