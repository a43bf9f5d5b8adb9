// SPDX-License-Identifier: GPL-3.0-or-later
/// @file  Lists of different lengths in one piece of memory.
#pragma once

#include <vector>

namespace flexpm {

template <class T> struct Lists {
    std::vector<int> first { 0 };  ///< index of the first item of each list, and of the end
    std::vector<T> items;          ///< of all lists, one after the other

    /// Items of one list.
    struct List {
        const T *from, *to;
        const T* begin() const { return from; }
        const T* end() const { return to; }
    };

    Lists() = default;
    explicit Lists(const std::vector<std::vector<T>>& lists)
    {
        for (const std::vector<T>& list : lists) {
            items.insert(items.end(), list.begin(), list.end());
            first.push_back(static_cast<int>(items.size()));
        }
    }

    int count() const { return static_cast<int>(first.size()) - 1; }
    List operator[](int list) const
    {
        return { items.data() + first[list], items.data() + first[list + 1] };
    }
};

}  // namespace flexpm
