; let the arm settle before looking
        PARK
        LENS    25
        AIM     PUMP
        WAIT    2
        LOOK    BEFORE
        OPEN    1.9
        MOVE    G
        CLOSE   .7
        PARK
        LOOK    AFTER HOLD
        INSPECT PUMP BEFORE AFTER
