#pragma once

#include <atomic>
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace raylab {

/// A value that copies share until one of them writes. To readers it is a plain T; whoever asks for a mutable T gets
/// one that nobody else sees. Different copies may be used by different threads, as with any value.
template <class T>
class Shared {
public:
    Shared() : value_(std::make_shared<T>()) {}
    Shared(T value) : value_(std::make_shared<T>(std::move(value))) {}

    const T& read() const { return *value_; }
    T& write() {
        if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
        std::atomic_thread_fence(std::memory_order_acquire);  // after what the last other owner did before it let go
        return *value_;
    }

    /// Whether both are one value in memory; equal values may still be two.
    bool sameAs(const Shared& other) const { return value_ == other.value_; }

private:
    std::shared_ptr<T> value_;
};

/// std::vector as far as scenes use it, with elements that copies of the list share: a copy costs a pointer an element.
/// Mutable access to an element that is shared copies that element.
template <class T>
class SharedList {
    template <class List, class Value>
    class Iterator {
    public:
        using iterator_category = std::random_access_iterator_tag;
        using value_type = T;
        using difference_type = std::ptrdiff_t;
        using pointer = Value*;
        using reference = Value&;

        Iterator() = default;
        Iterator(List* list, difference_type index) : list_(list), index_(index) {}
        reference operator*() const { return (*list_)[static_cast<size_t>(index_)]; }
        pointer operator->() const { return &**this; }
        reference operator[](difference_type n) const { return *(*this + n); }
        Iterator& operator+=(difference_type n) { return index_ += n, *this; }
        Iterator& operator-=(difference_type n) { return index_ -= n, *this; }
        Iterator& operator++() { return *this += 1; }
        Iterator& operator--() { return *this -= 1; }
        Iterator operator++(int) { return std::exchange(*this, *this + 1); }
        Iterator operator--(int) { return std::exchange(*this, *this - 1); }
        friend Iterator operator+(Iterator it, difference_type n) { return it += n; }
        friend Iterator operator+(difference_type n, Iterator it) { return it += n; }
        friend Iterator operator-(Iterator it, difference_type n) { return it -= n; }
        friend difference_type operator-(const Iterator& a, const Iterator& b) { return a.index_ - b.index_; }
        friend bool operator==(const Iterator& a, const Iterator& b) { return a.index_ == b.index_; }
        friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.index_ <=> b.index_; }

    private:
        List* list_ = nullptr;
        difference_type index_ = 0;
    };

public:
    using value_type = T;
    using iterator = Iterator<SharedList, T>;
    using const_iterator = Iterator<const SharedList, const T>;

    SharedList() = default;
    SharedList(std::initializer_list<T> values) {
        for (const T& value : values) push_back(value);
    }

    size_t size() const { return items_.size(); }
    bool empty() const { return items_.empty(); }
    void clear() { items_.clear(); }
    void reserve(size_t count) { items_.reserve(count); }
    void resize(size_t count) {
        items_.reserve(count);
        while (items_.size() > count) items_.pop_back();
        while (items_.size() < count) items_.emplace_back();
    }
    void push_back(T value) { items_.emplace_back(std::move(value)); }
    void pop_back() { items_.pop_back(); }

    const T& operator[](size_t i) const { return items_[i].read(); }
    T& operator[](size_t i) { return items_[i].write(); }
    const T& at(size_t i) const { return items_.at(i).read(); }
    T& at(size_t i) { return items_.at(i).write(); }
    const T& front() const { return items_.front().read(); }
    T& front() { return items_.front().write(); }
    const T& back() const { return items_.back().read(); }
    T& back() { return items_.back().write(); }

    const_iterator begin() const { return {this, 0}; }
    const_iterator end() const { return {this, static_cast<std::ptrdiff_t>(size())}; }
    iterator begin() { return {this, 0}; }
    iterator end() { return {this, static_cast<std::ptrdiff_t>(size())}; }

    /// The elements as what copies share.
    const std::vector<Shared<T>>& shared() const { return items_; }
    std::vector<Shared<T>>& shared() { return items_; }

private:
    std::vector<Shared<T>> items_;
};

/// std::optional as far as scenes use it, with a value that copies share.
template <class T>
class SharedOptional {
public:
    SharedOptional() = default;
    SharedOptional(std::nullopt_t) {}
    SharedOptional(T value) : value_(std::move(value)) {}

    bool has_value() const { return value_.has_value(); }
    explicit operator bool() const { return has_value(); }
    void reset() { value_.reset(); }
    const T& operator*() const { return value_->read(); }
    T& operator*() { return value_->write(); }
    const T* operator->() const { return &**this; }
    T* operator->() { return &**this; }

    /// Whether both hold nothing, or one value in memory.
    bool sameAs(const SharedOptional& other) const {
        if (!value_ || !other.value_) return has_value() == other.has_value();
        return value_->sameAs(*other.value_);
    }

private:
    std::optional<Shared<T>> value_;
};

}  // namespace raylab
