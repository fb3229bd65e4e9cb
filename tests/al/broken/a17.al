; from the tray into the box
        TRANS   P [24 32 7 90 90 0]
        TRANS   BOX [20 82 8 90 90 0]
        TRANS   PARK [20 30 12 90 90 0]
        OPEN    1
        MOVE    P
        CLOSE   .1
        MOVE    BOX
        OPEN    1
        PARK
