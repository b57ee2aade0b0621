#pragma once
/// The sanitizers with which the program is built. They change memory limits and the effect of signals.

namespace talus {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitizes_addresses = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool sanitizes_addresses = true;
#else
inline constexpr bool sanitizes_addresses = false;
#endif
#else
inline constexpr bool sanitizes_addresses = false;
#endif

#if defined(__SANITIZE_THREAD__)
inline constexpr bool sanitizes_threads = true;
#else
inline constexpr bool sanitizes_threads = false;
#endif

}  // namespace talus
