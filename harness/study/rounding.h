/* Numbers with as many digits as are known of them, for people. */
#ifndef BEAMWORK_ROUNDING_H
#define BEAMWORK_ROUNDING_H

enum { ROUNDING_TEXT = 32, ROUNDING_MOST = 11 /* digits */ };

/* With that many digits, "-" where it is not finite; without an exponent where that is short:
 * "0.0031", "3.1e-9". */
void rounding_digits(double value, int digits, char text[ROUNDING_TEXT]);
/* A value to the second digit of its uncertainty (same unit; 0: exact; not finite: seven digits).
 */
void rounding_known(double value, double uncertainty, char text[ROUNDING_TEXT]);
/* A relative error in percent: "-2.7801 %", "+2.1e-9 %". At most 11 characters. */
void rounding_percent(double error, char text[ROUNDING_TEXT]);

#endif
