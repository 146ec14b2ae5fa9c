/* library.c - shared libraries at run time, by dlopen; see library.h. */
#include "base/library.h"

#include <dlfcn.h>
#include <string.h>

bool library_load(const char *file, const char *const *name, size_t n, void *functions)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    for (size_t i = 0; library != NULL && i < n; i++) {
        void *function = dlsym(library, name[i]);
        if (function == NULL)
            return false;
        memcpy((char *)functions + i * sizeof function, &function, sizeof function);
    }
    return library != NULL;
}
