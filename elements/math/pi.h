/* The one pi. */
#ifndef BEAMWORK_PI_H
#define BEAMWORK_PI_H

#define PI 3.14159265358979323846

#endif
