        TRANS   RIM [42.97 28 3.75 180 90 0] OF BASE
        OPEN    1.775
        MOVE    RIM
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5
        SKIPE   23
        WAIT    "A FINGER STANDS ON THE CASTING"
        CENTER  .5
        OPEN    1.775
        CHANGE  [0 0 1] 2
        PARK
