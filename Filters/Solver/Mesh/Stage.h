// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is worked out once and kept as long as nothing that it depends on changes.
#ifndef SphericalStyle_Stage_h
#define SphericalStyle_Stage_h

#include <utility>

namespace SphericalStyle
{
/// A value and its key: all that it depends on, compared with ==. The keys of a class are its table
/// of what a change redoes.
///
/// A stage that is made from other stages has their versions in its key: where those are made anew,
/// so is this one. The number of threads belongs to no key, for results are the same bits.
template <typename Key, typename Value>
class Stage
{
public:
  /// Makes the value, unless it has been made for an equal key.
  /// @param make  called with the value as it was left; should it throw, the next call makes again
  /// @return whether it was made
  template <typename Make>
  bool Update(Key key, const Make& make)
  {
    if (this->Has(key))
    {
      return false;
    }
    this->Forget();
    ++this->Version;
    make(this->Made);
    this->MadeFor = std::move(key);
    this->IsMade = true;
    return true;
  }

  /// Whether the value has been made for an equal key.
  bool Has(const Key& key) const { return this->IsMade && this->MadeFor == key; }

  /// That of the value; Key{} where none is made.
  const Key& GetKey() const { return this->MadeFor; }

  /// The next Update makes the value anew. Its memory is kept until then.
  void Forget() noexcept
  {
    this->IsMade = false;
    this->MadeFor = Key{};
  }

  /// Another one for every value that was made.
  int GetVersion() const { return this->Version; }

  const Value& Get() const { return this->Made; }
  const Value* operator->() const { return &this->Made; }
  /// For what a value keeps to itself, as a factor does its scratch memory.
  Value& Use() { return this->Made; }

private:
  bool IsMade = false; // not while it is being made, nor where that has thrown
  Key MadeFor{};
  Value Made = Value(); // GCC 16 warns of {}
  int Version = 0;
};

/// The key of what depends on the mesh alone, in a class that a new mesh makes anew.
struct OfMesh
{
  bool operator==(const OfMesh&) const { return true; }
};
} // namespace SphericalStyle

#endif
