// SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Counts what fails and says what should have been. A test returns CheckResult() from main.
///
/// Why not doctest (2.4, measured): it takes as long to compile (1.3 s for 60 checks, 1.5 s here),
/// and of what it has beyond these macros, cases and their selection, CTest has as much: a test
/// here is a program.
#ifndef SphericalStyle_Check_h
#define SphericalStyle_Check_h

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>

namespace Check
{
inline int Checks = 0;
inline int Failures = 0;

inline void Note(bool passed, const char* file, int line, const std::string& message)
{
  ++Checks;
  // A broken formula fails everywhere: the first messages tell, the count says how much.
  if (!passed && ++Failures <= 25)
  {
    std::cerr << file << ":" << line << ": failed: " << message << std::endl;
  }
}
} // namespace Check

/// @param message  what should have been, a stream: "x is " << x
#define CHECK(condition, message)                                                                  \
  do                                                                                               \
  {                                                                                                \
    const bool passed_ = static_cast<bool>(condition);                                             \
    std::ostringstream stream_;                                                                    \
    if (!passed_)                                                                                  \
    {                                                                                              \
      stream_.precision(17);                                                                       \
      stream_ << message;                                                                          \
    }                                                                                              \
    Check::Note(passed_, __FILE__, __LINE__, stream_.str());                                       \
  } while (false)

/// |value - expected| <= tolerance; NaN fails.
#define CHECK_NEAR(value, expected, tolerance, what)                                               \
  do                                                                                               \
  {                                                                                                \
    const double value_ = (value);                                                                 \
    const double expected_ = (expected);                                                           \
    const double tolerance_ = (tolerance);                                                         \
    CHECK(std::abs(value_ - expected_) <= tolerance_,                                              \
      what << " is " << value_ << ", should be " << expected_ << " within " << tolerance_          \
           << ", differs by " << value_ - expected_);                                              \
  } while (false)

/// The statement must throw the type, with a message that holds the word.
#define CHECK_THROWS(type, statement, word)                                                        \
  do                                                                                               \
  {                                                                                                \
    std::string told_ = "nothing was thrown";                                                      \
    bool right_ = false;                                                                           \
    try                                                                                            \
    {                                                                                              \
      statement;                                                                                   \
    }                                                                                              \
    catch (const type& error_)                                                                     \
    {                                                                                              \
      told_ = error_.what();                                                                       \
      right_ = told_.find(word) != std::string::npos;                                              \
    }                                                                                              \
    catch (const std::exception& error_)                                                           \
    {                                                                                              \
      told_ = std::string("another type: ") + error_.what();                                       \
    }                                                                                              \
    CHECK(right_,                                                                                  \
      #statement " should throw " #type " with '" << word << "' in its message; got: " << told_);  \
  } while (false)

/// Prints the count. @return the exit code
inline int CheckResult()
{
  std::cout << Check::Checks << " checks, " << Check::Failures << " failed" << std::endl;
  return Check::Checks > 0 && Check::Failures == 0 ? 0 : 1;
}

#endif
