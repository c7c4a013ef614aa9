// Stable handles: slot + generation, so that a handle to something deleted is recognised and never reaches another thing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace atrium {

/// Handle into a SlotMap<T, Tag>. Default-constructed it is "none". Generations start at 1, so {0,0} is never live.
template <class Tag> struct Id {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0;

    explicit operator bool() const { return generation != 0; }
    friend bool operator==(Id, Id) = default;
    friend auto operator<=>(Id, Id) = default;
    /// One number for maps, logs and random streams.
    [[nodiscard]] std::uint64_t key() const { return (std::uint64_t(generation) << 32) | slot; }
};

/// Vector of T with stable ids, O(1) insert, erase and look-up. Iteration is in slot order (deterministic).
/// Value semantics; equality compares live entries and their ids. Not thread-safe.
template <class T, class Tag = T> class SlotMap {
public:
    using Key = Id<Tag>;

    /// Inserts in the lowest free slot and returns its id.
    Key insert(T value) {
        const Key key = next_key();
        restore(key, std::move(value));
        return key;
    }
    /// The id that the next insert() will give out; lets an edit name the thing that it is about to create.
    [[nodiscard]] Key next_key() const {
        for (std::size_t i = first_free_; i < slots_.size(); ++i) {
            if (!slots_[i].value) {
                return {std::uint32_t(i), slots_[i].newest + 1};
            }
        }
        return {std::uint32_t(slots_.size()), 1};
    }
    /// Puts a value back under an id that was live before (undo) or that next_key() gave. False if the slot is taken.
    bool restore(Key key, T value) {
        if (!key) {
            return false;
        }
        if (key.slot >= slots_.size()) {
            slots_.resize(std::size_t(key.slot) + 1);
        }
        Slot& slot = slots_[key.slot];
        if (slot.value) {
            return false;
        }
        slot.value.emplace(std::move(value));
        slot.generation = key.generation;
        slot.newest = slot.newest > key.generation ? slot.newest : key.generation;
        ++count_;
        while (first_free_ < slots_.size() && slots_[first_free_].value) {
            ++first_free_;
        }
        return true;
    }
    bool erase(Key key) {
        if (!contains(key)) {
            return false;
        }
        slots_[key.slot].value.reset();
        --count_;
        if (key.slot < first_free_) {
            first_free_ = key.slot;
        }
        return true;
    }
    [[nodiscard]] bool contains(Key key) const {
        return key && key.slot < slots_.size() && slots_[key.slot].value && slots_[key.slot].generation == key.generation;
    }
    [[nodiscard]] T* find(Key key) { return contains(key) ? &*slots_[key.slot].value : nullptr; }
    [[nodiscard]] const T* find(Key key) const { return contains(key) ? &*slots_[key.slot].value : nullptr; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    /// True when a value lives in the slot of `key`, whatever its generation: restore() would fail.
    [[nodiscard]] bool occupied(Key key) const { return key.slot < slots_.size() && slots_[key.slot].value.has_value(); }
    /// Slots ever used, live or not: every id given out so far has a slot below this.
    [[nodiscard]] std::size_t slot_count() const { return slots_.size(); }

    /// Calls f(id, value) for every live entry in slot order.
    template <class F> void for_each(F&& f) const {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i].value) {
                f(Key{std::uint32_t(i), slots_[i].generation}, *slots_[i].value);
            }
        }
    }
    /// Ids of all live entries in slot order.
    [[nodiscard]] std::vector<Key> keys() const {
        std::vector<Key> out;
        out.reserve(count_);
        for_each([&](Key k, const T&) { out.push_back(k); });
        return out;
    }
    friend bool operator==(const SlotMap& a, const SlotMap& b) {
        if (a.count_ != b.count_) {
            return false;
        }
        bool same = true;
        a.for_each([&](Key k, const T& v) {
            const T* other = b.find(k);
            same = same && other != nullptr && *other == v;
        });
        return same;
    }

private:
    struct Slot {
        std::optional<T> value;
        std::uint32_t generation = 0; ///< of the value that is or was here last
        std::uint32_t newest = 0;     ///< highest ever given out: after an undo put an older id back, it stays used up
    };
    std::vector<Slot> slots_;
    std::size_t count_ = 0;
    std::size_t first_free_ = 0;
};

} // namespace atrium

template <class Tag> struct std::hash<atrium::Id<Tag>> {
    std::size_t operator()(atrium::Id<Tag> id) const noexcept { return std::hash<std::uint64_t>{}(id.key()); }
};
