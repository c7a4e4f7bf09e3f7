#pragma once

#include <mrpt/rtti/CObject.h>
#include <mrpt/version.h>

// The declaration of an abstract class: one argument up to MRPT 2.13, two from 2.14 on.
// MRPT_VERSION is 0x258 for 2.5.8 and has two digits per part (0x020E00) since 2.10.2.
#if MRPT_VERSION >= 0x020E00
#define ONEAC_DEFINE_VIRTUAL_MRPT_OBJECT(Class) DEFINE_VIRTUAL_MRPT_OBJECT(Class, oneac)
#else
#define ONEAC_DEFINE_VIRTUAL_MRPT_OBJECT(Class) DEFINE_VIRTUAL_MRPT_OBJECT(Class)
#endif
