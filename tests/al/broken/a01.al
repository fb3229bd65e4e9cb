; put the pin on the tray
        TRANS   P [24 32 7 90 90 0]
        TRANS   T [20 28 8 90 90 0]
        OPEN    1
        MOVE    P               ;over the pin
        CLOES   .1
        MOVE    T
        OPEN    1
