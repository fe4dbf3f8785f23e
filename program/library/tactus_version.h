/* The version of Tactus. docs/library.md has the rule by which it changes. */
#ifndef TACTUS_VERSION_H
#define TACTUS_VERSION_H

#define TACTUS_VERSION_MAJOR 0
#define TACTUS_VERSION_MINOR 1
#define TACTUS_VERSION_PATCH 0

#endif
