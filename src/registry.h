/* registry.h - the tables of registry.c; ranks with api. */
#ifndef REGISTRY_H
#define REGISTRY_H

#include "scene/ops.h"

extern const Registry registry;

#endif
