/* penrose.h - the three aperiodic tilings, numbers 25 to 27. */
#ifndef PATTERN_PENROSE_H
#define PATTERN_PENROSE_H

double penrose_value(int number, double x, double z);

#endif
