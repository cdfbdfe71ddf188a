// Decimal digits of a number, see json_file.f90: the conversions of the C library take a third of the time of formatted statements
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Least and most significant digits that are tried
enum { LEAST = 15, MOST = 17 };

/// Digits of a finite positive number, 15, 16 or 17 of them: the fewest that are read back as the same number
///
/// Writes MOST characters, trailing ones "0", and the exponent of the first digit.
void contact_number_digits(double value, char digits[MOST], int *exponent)
{
    // sign, digits, a decimal point of several bytes in some languages, exponent
    char text[MOST + 24];
    int count = LEAST;
    for (; count <= MOST; count++) {
        snprintf(text, sizeof text, "%.*e", count - 1, value);
        if (strtod(text, NULL) == value || count == MOST) break;
    }
    const char *end = strchr(text, 'e');
    memset(digits, '0', MOST);
    digits[0] = text[0];
    memcpy(digits + 1, end - (count - 1), (size_t)(count - 1));
    *exponent = atoi(end + 1);
}
