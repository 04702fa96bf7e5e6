// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tread_base_quiet_boost_h
#define tread_base_quiet_boost_h

// Boost 1.74 prints notes about its own headers, some dozen lines each, where property trees and R-trees are
// compiled; nothing here uses what they warn of. Include this before these headers.
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#endif
#include <boost/config/header_deprecated.hpp>
#undef BOOST_HEADER_DEPRECATED
#define BOOST_HEADER_DEPRECATED(alternative)

#endif
