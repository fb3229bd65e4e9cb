        PARK
        LENS    25
        AIM     PUMP
        LOOK    WIDE
        GENERAL PUMP WIDE
        SKIPE   30
        JUMP    THERE
        WAIT    "NO PUMP ON THE TABLE"
THERE:  OPEN    .9
        MOVE    CRANK
        CENTER  .3
        OPEN    .44
        STOP    40
        TURN    ROTOR 60
        SKIPE   23
        WAIT    "THE ROTOR IS HARD TO TURN"
        OPEN    .9
        PARK
