#include "engine/io/gltf_json.h"

#include "engine/io/json_numbers.h"

#include <charconv>

namespace atrium::gltf {

void refuse(std::string where, std::string what, std::string hint) {
    throw Refusal{Error{"", std::move(where), std::move(what), std::move(hint)}};
}

std::string place(const Json& root, const char* key, std::size_t index) {
    std::string out = std::string(key) + "/" + std::to_string(index);
    const Json& all = section(root, key);
    if (index < all.size()) {
        if (const Json* name = find(all[index], "name"); name != nullptr && name->is_string()) {
            out += " (" + name->get<std::string>() + ")";
        }
    }
    return out;
}

const Json* find(const Json& object, const char* key) {
    if (!object.is_object()) {
        return nullptr;
    }
    const auto it = object.find(key);
    return it == object.end() ? nullptr : &*it;
}

const Json* find_object(const Json& object, const char* key, const std::string& where) {
    const Json* value = find(object, key);
    if (value != nullptr && !value->is_object()) {
        refuse(where, std::string("\"") + key + "\" is not an object");
    }
    return value;
}

const Json* find_array(const Json& object, const char* key, const std::string& where) {
    const Json* value = find(object, key);
    if (value != nullptr && !value->is_array()) {
        refuse(where, std::string("\"") + key + "\" is not an array");
    }
    return value;
}

const Json* find_extension(const Json& object, const char* name) {
    const Json* all = find(object, "extensions");
    const Json* value = all != nullptr ? find(*all, name) : nullptr;
    return value != nullptr && value->is_object() ? value : nullptr;
}

const Json& section(const Json& root, const char* key) {
    static const Json empty = Json::array();
    const Json* value = find_array(root, key, "");
    return value != nullptr ? *value : empty;
}

double number(const Json& object, const char* key, double fallback, const std::string& where) {
    const Json* value = find(object, key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->is_number()) {
        refuse(where, std::string("\"") + key + "\" is not a number");
    }
    // Everything is stored as float in the end: beyond its range a number would become infinite there.
    if (!float_of(*value)) {
        refuse(where, std::string("\"") + key + "\" is too large a number");
    }
    return value->get<double>();
}

vec3 number3(const Json& object, const char* key, const vec3& fallback, const std::string& where) {
    const Json* value = find(object, key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->is_array() || value->size() != 3) {
        refuse(where, std::string("\"") + key + "\" is not an array of three numbers");
    }
    vec3 out;
    for (int i = 0; i < 3; ++i) {
        const auto component = float_of((*value)[std::size_t(i)]);
        if (!component) {
            refuse(where, std::string("\"") + key + "\" is not an array of three finite numbers");
        }
        out[i] = *component;
    }
    return out;
}

bool boolean(const Json& object, const char* key, bool fallback, const std::string& where) {
    const Json* value = find(object, key);
    if (value == nullptr) {
        return fallback;
    }
    if (!value->is_boolean()) {
        refuse(where, std::string("\"") + key + "\" is neither true nor false");
    }
    return value->get<bool>();
}

std::string text(const Json& object, const char* key, const std::string& where) {
    const Json* value = find(object, key);
    if (value == nullptr) {
        return {};
    }
    if (!value->is_string()) {
        refuse(where, std::string("\"") + key + "\" is not a text");
    }
    return value->get<std::string>();
}

std::uint64_t whole(const Json& value, std::uint64_t least, std::uint64_t most, const std::string& where) {
    std::uint64_t out = 0;
    bool good = true;
    if (value.is_number_unsigned()) {
        out = value.get<std::uint64_t>();
    } else if (value.is_number_float()) {
        const double d = value.get<double>();
        good = d >= 0.0 && d < 0x1p53 && d == std::floor(d);
        out = good ? std::uint64_t(d) : 0;
    } else {
        good = false;
    }
    if (!good || out < least || out > most) {
        refuse(where, "is " + value.dump(-1, ' ', false, Json::error_handler_t::replace) +
                          " but must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return out;
}

int index(const Json& object, const char* key, std::size_t count, const std::string& where) {
    const Json* value = find(object, key);
    if (value == nullptr) {
        return -1;
    }
    if (count == 0) {
        refuse(where + "/" + key, "refers to something that the file does not have");
    }
    return int(whole(*value, 0, std::min<std::size_t>(count - 1, 0x7FFFFFFF), where + "/" + key));
}

std::string json_text(const Json& object, const char* key) {
    const Json* value = find(object, key);
    return value != nullptr ? value->dump(-1, ' ', false, Json::error_handler_t::replace) : std::string();
}

Json short_number(float value) {
    char digits[48];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    double parsed = 0.0;
    std::from_chars(digits, end, parsed);
    const double chosen = float(parsed) == value ? parsed : double(value);
    // 1 rather than 1.0 where nothing is lost.
    if (chosen == std::floor(chosen) && std::abs(chosen) < 1e15) {
        return Json(std::int64_t(chosen));
    }
    return Json(chosen);
}

Json short_numbers(const vec3& value) {
    return Json::array({short_number(value.x), short_number(value.y), short_number(value.z)});
}

} // namespace atrium::gltf
