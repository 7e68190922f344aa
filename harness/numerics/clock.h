/* The clocks of the house. */
#ifndef BEAMWORK_ALGEBRA_CLOCK_H
#define BEAMWORK_ALGEBRA_CLOCK_H

/* [s] that pass, whatever happens in them; from an arbitrary origin. */
double clock_wall_seconds(void);
/* [s] of the processor spent by this thread: other programs on the machine do not count. */
double clock_processor_seconds(void);

#endif
