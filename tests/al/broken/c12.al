; macro as a subroutine
DEFINE LETGO
        OPEN    1
        CHANGE  [0 0 1] 2

        OPEN    1
        MOVE    P1
        CLOSE   .1
        CHANGE  [0 0 1] 1.5
        MOVE    T1
        CALL    LETGO
        PARK
