/* library.h - shared libraries that are opened when first needed.
 *
 * Starting a program with libtiff and fontconfig takes longer than reading a small scene, for all that they bring along. A user
 * lists the functions it calls; LIBRARY_FIELD makes pointers of their own types and names in a struct of them. */
#ifndef BASE_LIBRARY_H
#define BASE_LIBRARY_H

#include <stdbool.h>
#include <stddef.h>

#define LIBRARY_FIELD(function) __typeof__(&function) function;
#define LIBRARY_NAME(function) #function,

/* Fills in n pointers by their names, from the library of that file name, which stays open (NULL: what the program is linked with).
 * False if it or one of them is not there. */
bool library_load(const char *file, const char *const *name, size_t n, void *functions);

#endif
