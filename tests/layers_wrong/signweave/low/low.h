#include "signweave/high/high.h"
