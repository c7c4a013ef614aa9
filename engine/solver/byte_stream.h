// Values and arrays as bytes that compress well, and back from bytes that may be damaged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace atrium {

/// Appends to `bytes`. Arrays are written as planes (all first bytes, then all second bytes, ...): exponents of neighbouring
/// numbers are alike, and side by side they compress.
class ByteWriter {
public:
    template <class T> void value(const T& v) {
        static_assert(std::is_trivially_copyable_v<T>);
        const auto* p = reinterpret_cast<const std::byte*>(&v);
        bytes.insert(bytes.end(), p, p + sizeof(T));
    }
    /// The count as 64 bits, then the planes.
    template <class T> void array(const std::vector<T>& v) {
        value(std::uint64_t(v.size()));
        planes(std::span<const T>(v));
    }
    /// The planes alone, for counts that the reader knows.
    template <class T> void planes(std::span<const T> v) {
        static_assert(std::is_standard_layout_v<T> &&
                      std::is_trivially_destructible_v<T>); // plain numbers, or GLM's vectors
        const std::size_t at = bytes.size();
        bytes.resize(at + v.size_bytes());
        const auto* from = reinterpret_cast<const std::byte*>(v.data());
        std::byte* to = bytes.data() + at;
        for (std::size_t plane = 0; plane < sizeof(T); ++plane) {
            for (std::size_t i = 0; i < v.size(); ++i) {
                *to++ = from[i * sizeof(T) + plane];
            }
        }
    }
    std::vector<std::byte> bytes;
};

/// Reads what ByteWriter wrote. Every function is false, and allocates nothing, when fewer bytes are left than it needs.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> b) : bytes_(b) {}
    template <class T> bool value(T& v) {
        if (left() < sizeof(T)) {
            return false;
        }
        std::memcpy(&v, bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        return true;
    }
    template <class T> bool array(std::vector<T>& v) {
        std::uint64_t count = 0;
        return value(count) && planes(v, count);
    }
    template <class T> bool planes(std::vector<T>& v, std::uint64_t count) {
        if (count > left() / sizeof(T)) {
            return false;
        }
        v.resize(count);
        auto* to = reinterpret_cast<std::byte*>(v.data());
        for (std::size_t plane = 0; plane < sizeof(T); ++plane) {
            for (std::size_t i = 0; i < count; ++i) {
                to[i * sizeof(T) + plane] = bytes_[at_++];
            }
        }
        return true;
    }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

} // namespace atrium
