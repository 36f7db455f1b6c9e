#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace grasp_affordances::fuzz
{

/// Takes values from the front of a fuzzer's input. Where the input has ended, every value is zero.
class ByteReader
{
public:
  ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <typename T>
  T take()
  {
    T value{};
    if (size_ >= sizeof(T)) {
      std::memcpy(&value, data_, sizeof(T));
      data_ += sizeof(T);
      size_ -= sizeof(T);
    } else {
      size_ = 0;
    }
    return value;
  }

  std::uint8_t byte() { return take<std::uint8_t>(); }
  std::size_t left() const { return size_; }
  const std::uint8_t* rest() const { return data_; }

private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// Writes what a ByteReader takes.
class ByteWriter
{
public:
  template <typename T>
  ByteWriter& put(T value)
  {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }

  ByteWriter& byte(unsigned value) { return put(static_cast<std::uint8_t>(value)); }
  const std::string& bytes() const { return bytes_; }

private:
  std::string bytes_;
};

}  // namespace grasp_affordances::fuzz
